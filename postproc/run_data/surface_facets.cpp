#include "postproc/run_data/surface_facets.hpp"

#include <algorithm>
#include <tuple>

namespace mpfem {

std::vector<SurfaceFacet> surface_facets(const Snapshot& snapshot, const std::vector<std::int32_t>& tets) {
  struct Candidate {
    std::array<std::int32_t, 3> sorted;
    SurfaceFacet facet;
    auto key() const { return std::tie(facet.grain, sorted); }
  };
  // Opposite to each corner; outward where the tet's volume is positive.
  static constexpr std::size_t corner[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  std::vector<Candidate> candidates;
  candidates.reserve(4 * tets.size());
  for (const std::int32_t number : tets) {
    const auto t = static_cast<std::size_t>(number);
    for (const auto& c : corner) {
      Candidate candidate;
      candidate.facet.grain = snapshot.tet_grain[t];
      for (std::size_t k = 0; k < 3; ++k) candidate.facet.node[k] = snapshot.tet[4 * t + c[k]];
      candidate.sorted = candidate.facet.node;
      std::sort(candidate.sorted.begin(), candidate.sorted.end());
      candidates.push_back(candidate);
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.key() < b.key(); });
  std::vector<SurfaceFacet> facets;
  for (std::size_t i = 0, end = 0; i < candidates.size(); i = end) {
    for (end = i + 1; end < candidates.size() && candidates[end].key() == candidates[i].key();) ++end;
    if (end == i + 1) facets.push_back(candidates[i].facet);
  }
  return facets;
}

std::vector<std::int32_t> tets_of_grain(const Snapshot& snapshot, std::int32_t grain) {
  std::vector<std::int32_t> tets;
  for (std::size_t t = 0; t < snapshot.tets(); ++t)
    if (snapshot.tet_grain[t] == grain) tets.push_back(static_cast<std::int32_t>(t));
  return tets;
}

} // namespace mpfem
