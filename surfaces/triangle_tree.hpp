#pragma once
// A tree of boxes around triangles, to find the triangle closest to a point, or all that are close to it.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surfaces/flat_triangle.hpp"

namespace mpfem {

/// Immutable after construction.
class TriangleTree {
public:
  /// `margin` in mm, see FlatTriangle::offer. Needs at least one triangle.
  TriangleTree(std::span<const FlatTriangle> triangles, double margin);

  /// The point of the triangles closest to x (mm). The search starts from triangle `first`, which may be any: the
  /// closer it is, the faster the search. With `slack` above 1 the result may be another point, but the closest one is
  /// no closer than its distance over `slack`. This saves testing all triangles for a point in the middle of a round
  /// body, which is about equally far from all of them.
  Nearest nearest(const Vector3<double>& x, std::int32_t first, double slack = 1) const;
  /// Calls visit(nearest) with the closest point of each triangle that is less than `reach` (mm) from x. Triangles that
  /// share this point each call once.
  template <class Visit>
  void for_each_within(const Vector3<double>& x, double reach, Visit visit) const {
    std::array<std::int32_t, levels> waiting; // NOLINT: set before it is read
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      const std::int32_t index = waiting[--count];
      const Node& node = node_[static_cast<std::size_t>(index)];
      if (node.squared_distance(x) >= reach * reach) continue;
      for (std::int32_t i = node.second; i < node.second + node.count; ++i) {
        const auto slot = static_cast<std::size_t>(i);
        Nearest closest{reach * reach, -1, Feature::face, {}};
        triangle_[slot].offer(x, number_[slot], margin_, closest);
        if (closest.triangle >= 0) visit(closest);
      }
      if (node.count > 0) continue;
      waiting[count++] = node.second;
      waiting[count++] = index + 1;
    }
  }
  /// The triangle of this number, as given.
  const FlatTriangle& triangle(std::int32_t number) const {
    return triangle_[static_cast<std::size_t>(slot_[static_cast<std::size_t>(number)])];
  }

private:
  static constexpr std::size_t levels = 64; ///< entries that wait: one per level, and 2^32 triangles have 32 levels

  /// The first of two children follows its parent; a leaf has triangles instead.
  struct Node {
    std::array<double, 3> low, high; ///< mm
    std::int32_t second = 0;         ///< the second child, or a leaf's first triangle
    std::int32_t count = 0;          ///< number of a leaf's triangles; 0: not a leaf
    double squared_distance(const Vector3<double>& x) const {
      const auto beyond = [](double value, double from, double to) {
        return std::max({from - value, value - to, 0.0});
      };
      const double a = beyond(x.x, low[0], high[0]), b = beyond(x.y, low[1], high[1]), c = beyond(x.z, low[2], high[2]);
      return a * a + b * b + c * c;
    }
  };
  struct Build;

  std::vector<Node> node_;
  std::vector<FlatTriangle> triangle_; ///< ordered by leaf
  std::vector<std::int32_t> number_;   ///< [triangles]: given numbers, in the order of triangle_
  std::vector<std::int32_t> slot_;     ///< [triangles]: index in triangle_ of each given number
  double margin_;
};

} // namespace mpfem
