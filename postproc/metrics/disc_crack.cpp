#include "postproc/metrics/disc_crack.hpp"

#include <cmath>
#include <set>

namespace mpfem {

namespace {

/// Where a bond was before the test.
struct Place {
  bool near_diameter = false, in_centre = false;
};

Place place_of(const BondRow& bond, const DiscGeometry& disc) {
  const auto from_middle = [&](int axis) {
    const auto k = static_cast<std::size_t>(axis);
    return static_cast<double>(disc.node[3 * static_cast<std::size_t>(bond.node) + k]) - disc.middle[k];
  };
  const double aside = from_middle(disc.across);
  if (std::abs(aside) > disc.diameter / 8) return {};
  return {true, std::hypot(aside, from_middle(disc.load_axis)) <= 0.3 * disc.diameter};
}

} // namespace

std::optional<DiscCrack> disc_crack(const std::vector<BondRow>& before, const std::vector<BondRow>& after,
                                    const DiscGeometry& disc) {
  std::set<std::pair<std::int32_t, std::int32_t>> broken_before, whole_before;
  double whole_near = 0, whole_in_centre = 0; // mm^2
  for (const BondRow& bond : before) {
    if (bond.broken()) {
      broken_before.emplace(bond.node, bond.grain);
      continue;
    }
    whole_before.emplace(bond.node, bond.grain);
    const Place place = place_of(bond, disc);
    whole_near += place.near_diameter ? bond.area : 0;
    whole_in_centre += place.in_centre ? bond.area : 0;
  }
  DiscCrack crack;
  double near_diameter = 0, in_centre = 0, of_centre = 0; // mm^2
  for (const BondRow& bond : after) {
    if (!bond.broken() || broken_before.contains({bond.node, bond.grain})) continue;
    const Place place = place_of(bond, disc);
    crack.area += bond.area;
    near_diameter += place.near_diameter ? bond.area : 0;
    in_centre += place.in_centre ? bond.area : 0;
    if (whole_before.contains({bond.node, bond.grain})) of_centre += place.in_centre ? bond.area : 0;
  }
  if (!(crack.area > 0)) return {};
  crack.near_diameter = near_diameter / crack.area;
  crack.in_centre = in_centre / crack.area;
  if (whole_in_centre > 0) crack.of_centre = of_centre / whole_in_centre;
  if (whole_near > 0) crack.in_centre_if_even = crack.near_diameter * whole_in_centre / whole_near;
  return crack;
}

} // namespace mpfem
