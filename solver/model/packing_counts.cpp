#include "solver/model/packing_counts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "results-schema/descriptors.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

namespace {

constexpr double facets_of_ball = 3.15; // over tets^(2/3)

} // namespace

std::int64_t PackingCounts::all_tets() const {
  return std::accumulate(tets.begin(), tets.end(), std::int64_t{0});
}

double PackingCounts::facets() const {
  double facets = 0;
  for (const std::int64_t of_grain : tets)
    facets += facets_of_ball * std::pow(static_cast<double>(of_grain), 2.0 / 3.0);
  return facets;
}

PackingCounts read_packing_counts(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::packing);
  PackingCounts counts;
  if (!file.has(schema::packing::mesh_tet)) return counts; // read_packing() reports it
  counts.nodes = static_cast<std::int64_t>(file.rows(schema::packing::mesh_node));
  const auto offset = file.read(schema::packing::mesh_grain_tet_offset);
  for (std::size_t g = 0; g + 1 < offset.size(); ++g)
    counts.tets.push_back(std::max<std::int64_t>(std::int64_t{offset[g + 1]} - offset[g], 0));
  return counts;
}

} // namespace mpfem
