#pragma once
// A tree of boxes around triangles, to find the one that is closest to a point.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surfaces/flat_triangle.hpp"

namespace mpfem {

class TriangleTree {
public:
  /// `margin` in mm, see FlatTriangle::offer. There is one triangle at least.
  TriangleTree(std::span<const FlatTriangle> triangles, double margin);

  /// The place of the triangles' surface that is closest to a point (mm). The search starts from triangle `first`, any
  /// one: the closer it is, the faster. With `slack` above 1 it may be another place, but the closest one is no closer
  /// than that over `slack`: of a point in the middle of a round body, to which all triangles are about as close, it
  /// does not look at them all.
  Nearest nearest(const Vector3<double>& x, std::int32_t first, double slack = 1) const;
  /// As it was given, by its number.
  const FlatTriangle& triangle(std::int32_t number) const {
    return triangle_[static_cast<std::size_t>(slot_[static_cast<std::size_t>(number)])];
  }

private:
  /// The first of two children follows its parent; a leaf has triangles instead.
  struct Node {
    std::array<double, 3> low, high; ///< mm
    std::int32_t second = 0;         ///< the second child, or a leaf's first triangle
    std::int32_t count = 0;          ///< a leaf's triangles; 0: no leaf
    double squared_distance(const Vector3<double>& x) const;
  };
  struct Build;

  std::vector<Node> node_;
  std::vector<FlatTriangle> triangle_; ///< by leaf
  std::vector<std::int32_t> number_;   ///< [triangles]: by leaf, as they were given
  std::vector<std::int32_t> slot_;     ///< [triangles]: as they were given, by leaf
  double margin_;
};

} // namespace mpfem
