#include "pack-gen/sphere_order.hpp"

#include <algorithm>
#include <utility>

#include "common/morton_key.hpp"

namespace mpfem {

SpherePacking along_a_curve(const SpherePacking& packing) {
  const double longest = *std::max_element(packing.box.begin(), packing.box.end());
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < packing.radius.size(); ++i) {
    const Point& x = packing.center[i];
    order.emplace_back(morton_key({x[0] / longest, x[1] / longest, x[2] / longest}), i);
  }
  std::sort(order.begin(), order.end());
  SpherePacking result = packing;
  for (std::size_t place = 0; place < order.size(); ++place) {
    result.center[place] = packing.center[order[place].second];
    result.radius[place] = packing.radius[order[place].second];
  }
  return result;
}

SpherePacking numbered(const SpherePacking& packing) {
  return packing.radius.size() > any_order_up_to ? along_a_curve(packing) : packing;
}

} // namespace mpfem
