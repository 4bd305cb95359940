#pragma once
// Removes triangles without area, whose corners lie on one line, from a closed surface without opening it.
//
// Such triangles are written where a corner of one triangle lies on the edge of another. They have no normal, and
// leaving one out would open the surface. Instead its longest edge is flipped: with the neighbour across that edge it
// forms a quadrilateral of the neighbour's shape, which the other diagonal splits into two triangles with area.

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

/// Result for the triangles below an area.
struct SliverFlips {
  std::size_t flipped = 0;   ///< number of edges flipped
  std::size_t left = 0;      ///< number of triangles still below the area
  std::int32_t example = -1; ///< one of these; -1: none
};

/// Flips edges until no triangle has an area below `least` (mm^2) or flips no longer help. Updates `partner` of the
/// closed surface (EdgePairs); vertices do not change.
SliverFlips flip_slivers(TriangleMesh& mesh, std::vector<std::int32_t>& partner, double least);

} // namespace mpfem
