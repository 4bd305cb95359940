#pragma once
// The closest point of one triangle.
//
// All lengths are measured along unit vectors, which are computed once from the best-conditioned edges. Barycentric
// coordinates divide by the squared area and lose all digits on the thin triangles that CAD programs write; in-plane
// distances from the edges do not.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Where a triangle is closest: on its face (0), on the edge from corner k (1 + k), or at corner k (4 + k).
enum class Feature : std::int32_t { face = 0, first_edge = 1, first_corner = 4 };

/// The closest point found so far.
struct Nearest {
  double squared; ///< mm^2, distance
  std::int32_t triangle;
  Feature feature;
  Vector3<double> point; ///< mm; unset where the feature is a face
};

/// A triangle with its unit vectors.
struct FlatTriangle {
  std::array<Vector3<double>, 3> corner; ///< mm
  Vector3<double> normal;                ///< unit
  std::array<Vector3<double>, 3> inward; ///< unit, in the plane, from each edge towards the triangle

  /// Height (mm) above the plane; positive on the side of the normal.
  double height(const Vector3<double>& x) const { return dot(x - corner[0], normal); }
  /// Writes itself, as triangle `number`, to `best` if it is closer. Points beyond an edge by less than `margin` (mm)
  /// count as over the face: the face's normal is exact, whereas a direction through the edge has rounding errors.
  inline void offer(const Vector3<double>& x, std::int32_t number, double margin, Nearest& best) const;
};

/// Needs three corners that do not lie on one line.
inline FlatTriangle flat_triangle(const std::array<Vector3<double>, 3>& corner) {
  const auto edge = [&](std::size_t k) { return corner[(k + 1) % 3] - corner[k]; };
  const auto squared = [&](std::size_t k) { return dot(edge(k), edge(k)); };
  const std::size_t longest = squared(0) >= squared(1) && squared(0) >= squared(2) ? 0
                              : squared(1) >= squared(2)                           ? 1
                                                                                   : 2;
  const Vector3<double> along = (1 / norm(edge(longest))) * edge(longest),
                        side = corner[(longest + 2) % 3] - corner[longest];
  const Vector3<double> across = side - dot(side, along) * along, area = cross(along, across);
  FlatTriangle triangle{corner, (1 / norm(area)) * area, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3<double> in = cross(triangle.normal, edge(k));
    triangle.inward[k] = (1 / norm(in)) * in;
  }
  return triangle;
}

inline void FlatTriangle::offer(const Vector3<double>& x, std::int32_t number, double margin, Nearest& best) const {
  const double d = height(x);
  if (d * d >= best.squared) return;
  bool over_face = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3<double> from_corner = x - corner[k];
    if (dot(from_corner, inward[k]) >= -margin) continue;
    over_face = false; // the closest point lies on an edge that the point is beyond
    const Vector3<double> edge = corner[(k + 1) % 3] - corner[k];
    const double share = std::clamp(dot(from_corner, edge) / dot(edge, edge), 0.0, 1.0);
    const Vector3<double> point = share < 1 ? corner[k] + share * edge : corner[(k + 1) % 3], way = x - point;
    const double squared = dot(way, way);
    if (squared >= best.squared) continue;
    const std::size_t feature = share <= 0 ? 4 + k : share >= 1 ? 4 + (k + 1) % 3 : 1 + k;
    best = {squared, number, static_cast<Feature>(feature), point};
  }
  if (over_face) best = {d * d, number, Feature::face, {}};
}

} // namespace mpfem
