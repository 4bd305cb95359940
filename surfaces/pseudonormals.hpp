#pragma once
// Directions that tell on which side of a closed surface a point lies, whatever the closest point on it is.
//
// On a face it is the normal, on an edge the sum of both faces' normals, at a corner the sum of the normals around it,
// each times the triangle's angle there. Only with the angles the sign is right for every closed surface (Baerentzen
// and Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 243, 2005): unweighted means and the normal of any one face fail at
// sharp corners.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surfaces/flat_triangle.hpp"

namespace mpfem {

struct Pseudonormals {
  std::vector<Vector3<double>> direction; ///< unit vectors, of edges and corners, one for all who share it
  std::vector<std::array<std::int32_t, 6>> edge_or_corner; ///< [triangles]: of its edges and then of its corners

  /// Unit vector; `feature` of a triangle, an edge or a corner.
  const Vector3<double>& of(std::int32_t triangle, Feature feature) const {
    const auto& six = edge_or_corner[static_cast<std::size_t>(triangle)];
    return direction[static_cast<std::size_t>(six[static_cast<std::size_t>(feature) - 1])];
  }
};

/// `partner` of the closed surface (EdgePairs) that the triangles make up.
Pseudonormals pseudonormals(std::span<const FlatTriangle> triangles, const std::vector<std::int32_t>& partner);

} // namespace mpfem
