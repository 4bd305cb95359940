#include "postproc/run_data/surface_facets.hpp"

#include <map>

#include "common/tet_boundary.hpp"

namespace mpfem {

std::vector<SurfaceFacet> surface_facets(const Snapshot& snapshot, const std::vector<std::int32_t>& tets) {
  std::map<std::int32_t, std::vector<std::int32_t>> nodes; // of the tets of each grain, four each
  for (const std::int32_t number : tets) {
    const auto t = static_cast<std::size_t>(number);
    const auto first = snapshot.tet.begin() + static_cast<std::ptrdiff_t>(4 * t);
    auto& of_grain = nodes[snapshot.tet_grain[t]];
    of_grain.insert(of_grain.end(), first, first + 4);
  }
  std::vector<SurfaceFacet> facets;
  for (const auto& [grain, tet] : nodes)
    for (const auto& face : tet_boundary(tet).face) facets.push_back({face, grain});
  return facets;
}

std::vector<std::int32_t> tets_of_grain(const Snapshot& snapshot, std::int32_t grain) {
  std::vector<std::int32_t> tets;
  for (std::size_t t = 0; t < snapshot.tets(); ++t)
    if (snapshot.tet_grain[t] == grain) tets.push_back(static_cast<std::int32_t>(t));
  return tets;
}

} // namespace mpfem
