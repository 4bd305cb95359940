#pragma once
// Triangles without area, whose three corners lie on one line, are taken out of a closed surface without a hole.
//
// Programs put them where a corner of one triangle lies on the edge of another. Such a triangle has no normal, and to
// leave it out would open the surface. Its longest edge is flipped instead: with the neighbour across that edge it
// forms a quadrangle whose shape is the neighbour's, and the other diagonal splits that into two triangles with area.

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

/// What became of the triangles below an area.
struct SliverFlips {
  std::size_t flipped = 0; ///< edges
  std::size_t left = 0;    ///< triangles that are still below the area
  std::int32_t example = -1;
};

/// Flips edges until no triangle has an area below `least` (mm^2) or flips no longer help. `partner` of a closed
/// surface (EdgePairs) is kept up to date; vertices stay.
SliverFlips flip_slivers(TriangleMesh& mesh, std::vector<std::int32_t>& partner, double least);

} // namespace mpfem
