#include "postproc/disc_crack.hpp"

#include <cmath>
#include <set>

namespace mpfem {

std::optional<DiscCrack> disc_crack(const std::vector<BondRow>& before, const std::vector<BondRow>& after,
                                    const DiscGeometry& disc) {
  std::set<std::pair<std::int32_t, std::int32_t>> broken_before;
  for (const BondRow& bond : before)
    if (bond.broken()) broken_before.emplace(bond.node, bond.grain);
  DiscCrack crack;
  double near_diameter = 0, in_centre = 0;
  for (const BondRow& bond : after) {
    if (!bond.broken() || broken_before.contains({bond.node, bond.grain})) continue;
    const auto from_middle = [&](int axis) {
      const auto k = static_cast<std::size_t>(axis);
      return static_cast<double>(disc.node[3 * static_cast<std::size_t>(bond.node) + k]) - disc.middle[k];
    };
    const double aside = from_middle(disc.across);
    crack.area += bond.area;
    if (std::abs(aside) > disc.diameter / 8) continue;
    near_diameter += bond.area;
    if (std::hypot(aside, from_middle(disc.load_axis)) <= 0.3 * disc.diameter) in_centre += bond.area;
  }
  if (!(crack.area > 0)) return {};
  crack.near_diameter = near_diameter / crack.area;
  crack.in_centre = in_centre / crack.area;
  return crack;
}

} // namespace mpfem
