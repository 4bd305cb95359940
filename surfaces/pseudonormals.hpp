#pragma once
// Directions that decide on which side of a closed surface a point lies, wherever its closest point is.
//
// On a face this is the normal, on an edge the sum of both faces' normals, at a corner the sum of the surrounding
// normals, each weighted by the triangle's angle there. Only with these weights is the sign correct for every closed
// surface (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 243, 2005): unweighted means, and the normal of
// any single face, fail at sharp corners.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surfaces/flat_triangle.hpp"

namespace mpfem {

/// The directions of all edges and corners of a surface.
struct Pseudonormals {
  std::vector<Vector3<double>> direction; ///< unit vectors of edges and corners, each shared by its triangles
  std::vector<std::array<std::int32_t, 6>> edge_or_corner; ///< [triangles]: indices for its edges, then its corners

  /// Unit vector of a triangle's `feature`, which is an edge or a corner.
  const Vector3<double>& of(std::int32_t triangle, Feature feature) const {
    const auto& six = edge_or_corner[static_cast<std::size_t>(triangle)];
    return direction[static_cast<std::size_t>(six[static_cast<std::size_t>(feature) - 1])];
  }
};

/// `partner` is that of the closed surface which the triangles form (EdgePairs).
Pseudonormals pseudonormals(std::span<const FlatTriangle> triangles, const std::vector<std::int32_t>& partner);

} // namespace mpfem
