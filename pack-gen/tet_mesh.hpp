#pragma once
// A tetrahedral mesh, as plain arrays.

#include <array>
#include <cstdint>
#include <vector>

namespace mpfem {

using Point = std::array<double, 3>;
using Tet = std::array<std::int32_t, 4>;   ///< 0-based; positive volume: (p1-p0) x (p2-p0) . (p3-p0) > 0
using Facet = std::array<std::int32_t, 3>; ///< 0-based; counter-clockwise seen from outside

/// Nodes, and tets as numbers of nodes.
struct TetMesh {
  std::vector<Point> node; ///< mm
  std::vector<Tet> tet;
};

} // namespace mpfem
