#pragma once
// Which faces of tetrahedra are on the boundary of the body that they make up.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mpfem {

/// Faces of tets, as three numbers of nodes each.
struct TetBoundary {
  /// The faces that belong to one tet only, counter-clockwise seen from outside where the tet's volume is positive; in
  /// the order of their ascending nodes.
  std::vector<std::array<std::int32_t, 3>> face;
  /// A face of more than two tets.
  struct Crowded {
    std::array<std::int32_t, 3> node{}; ///< ascending
    std::size_t tets = 0;
  };
  std::optional<Crowded> crowded; ///< the first, by its nodes; empty where no more than two tets share a face
};

/// Of the tets `tet` [tets * 4], numbers of nodes: positive volume where (p1-p0) x (p2-p0) . (p3-p0) > 0.
TetBoundary tet_boundary(std::span<const std::int32_t> tet);

} // namespace mpfem
