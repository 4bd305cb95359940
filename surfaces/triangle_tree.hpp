#pragma once
// A tree of boxes around triangles, to find the triangle closest to a point.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surfaces/flat_triangle.hpp"

namespace mpfem {

class TriangleTree {
public:
  /// `margin` in mm, see FlatTriangle::offer. Needs at least one triangle.
  TriangleTree(std::span<const FlatTriangle> triangles, double margin);

  /// The point of the triangles closest to x (mm). The search starts from triangle `first`, which may be any: the
  /// closer it is, the faster the search. With `slack` above 1 the result may be another point, but the closest one is
  /// no closer than its distance over `slack`. This saves testing all triangles for a point in the middle of a round
  /// body, which is about equally far from all of them.
  Nearest nearest(const Vector3<double>& x, std::int32_t first, double slack = 1) const;
  /// The triangle of this number, as given.
  const FlatTriangle& triangle(std::int32_t number) const {
    return triangle_[static_cast<std::size_t>(slot_[static_cast<std::size_t>(number)])];
  }

private:
  /// The first of two children follows its parent; a leaf has triangles instead.
  struct Node {
    std::array<double, 3> low, high; ///< mm
    std::int32_t second = 0;         ///< the second child, or a leaf's first triangle
    std::int32_t count = 0;          ///< number of a leaf's triangles; 0: not a leaf
    double squared_distance(const Vector3<double>& x) const;
  };
  struct Build;

  std::vector<Node> node_;
  std::vector<FlatTriangle> triangle_; ///< ordered by leaf
  std::vector<std::int32_t> number_;   ///< [triangles]: given numbers, in the order of triangle_
  std::vector<std::int32_t> slot_;     ///< [triangles]: index in triangle_ of each given number
  double margin_;
};

} // namespace mpfem
