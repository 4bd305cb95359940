#pragma once
// The outer facets of grains.

#include <array>
#include <cstdint>
#include <vector>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// A triangle of a grain's surface, counter-clockwise seen from outside.
struct SurfaceFacet {
  std::array<std::int32_t, 3> node{};
  std::int32_t grain = 0;
};

/// Facets that belong to exactly one of the given tets (two tets share a facet if they belong to the same grain and
/// have the same three nodes). For all tets of a grain, this is its surface. Ordered by grain and nodes.
std::vector<SurfaceFacet> surface_facets(const Snapshot& snapshot, const std::vector<std::int32_t>& tets);

/// The numbers of the tets of one grain.
std::vector<std::int32_t> tets_of_grain(const Snapshot& snapshot, std::int32_t grain);

} // namespace mpfem
