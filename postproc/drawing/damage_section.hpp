#pragma once
// The damage of bonds along the grains' boundaries in a plane section.

#include <array>
#include <string>
#include <vector>

#include "postproc/drawing/section.hpp"

namespace mpfem {

/// Part of a grain's boundary in the plane: the cut through one facet of its surface. Coordinates as in SectionPolygon.
struct BoundarySegment {
  std::array<double, 2> from{}, to{};      ///< mm
  double damage_from = -1, damage_to = -1; ///< 0 intact … 1 broken, linear in between; both -1: never bonded
  std::int32_t grain = 0;
};

/// The boundaries of all grains that the plane cuts, with the damage of their nodes (the node field "damage")
/// interpolated along the cut edges. On an edge to a node that was never bonded, the damage of the bonded node holds up
/// to the middle, as its tributary area does; a segment with only one bonded end is split at its middle. Throws
/// InputError where the snapshot has no damage.
std::vector<BoundarySegment> cut_boundaries(const Snapshot& snapshot, const CutPlane& plane);

/// The segments as CSV: grain, both ends, length, damage at both ends.
std::string damage_section_csv(const std::vector<BoundarySegment>& segments);

} // namespace mpfem
