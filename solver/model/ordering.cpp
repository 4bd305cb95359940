#include "solver/model/ordering.hpp"

#include <algorithm>
#include <utility>

#include "common/index.hpp"
#include "common/morton_key.hpp"
#include "solver/parallel/grain_values.hpp"
#include "solver/physics/tet4_patch.hpp"

namespace mpfem {

using Index = std::int32_t;

void order_in_patches(std::span<Index> tets, const std::function<const Vector3<double>&(Index)>& centre) {
  const auto count = static_cast<Index>(tets.size());
  if (count <= patch_tets) {
    std::sort(tets.begin(), tets.end());
    return;
  }
  using Component = double Vector3<double>::*;
  Component longest = nullptr;
  double length = -1;
  for (const Component component : {&Vector3<double>::x, &Vector3<double>::y, &Vector3<double>::z}) {
    const auto [least, most] = std::minmax_element(
        tets.begin(), tets.end(), [&](Index a, Index b) { return centre(a).*component < centre(b).*component; });
    if (centre(*most).*component - centre(*least).*component > length) {
      length = centre(*most).*component - centre(*least).*component;
      longest = component;
    }
  }
  const auto half = at((count + patch_tets - 1) / patch_tets / 2 * patch_tets);
  std::nth_element(tets.begin(), tets.begin() + static_cast<std::ptrdiff_t>(half), tets.end(), [&](Index a, Index b) {
    return std::pair(centre(a).*longest, a) < std::pair(centre(b).*longest, b);
  });
  order_in_patches(tets.first(half), centre);
  order_in_patches(tets.subspan(half), centre);
}

std::vector<Index> spatial_order(const Model& model, const Communicator& ranks) {
  const double size = *std::max_element(model.box_high.begin(), model.box_high.end());
  std::vector<std::uint64_t> key(at(model.grains));
  for (const Index g : model.own()) {
    const std::size_t first = model.first_node(g), count = at(model.surface_node_count[at(g)]);
    Vector3<double> centre{0, 0, 0};
    for (std::size_t n = first; n < first + count; ++n)
      centre = centre + (1.0 / static_cast<double>(count)) * model.point(n);
    key[at(g)] = morton_key({centre.x / size, centre.y / size, centre.z / size});
  }
  share_of_grains(ranks, model.ownership, std::span(key));
  std::vector<std::pair<std::uint64_t, Index>> order;
  for (Index g = 0; g < model.grains; ++g) order.emplace_back(key[at(g)], g);
  std::sort(order.begin(), order.end());
  std::vector<Index> grains;
  for (const auto& [place, grain] : order) grains.push_back(grain);
  return grains;
}

} // namespace mpfem
