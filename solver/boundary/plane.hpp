#pragma once
// A rigid plane across a coordinate axis.

#include <cstddef>

#include "solver/boundary/rigid_surface.hpp"

namespace mpfem {

/// A direction along a coordinate axis.
struct AxisNormal {
  std::size_t axis;
  double sign; ///< 1 or -1
  Vector3<double> vector() const { return along_axis(axis, sign); }
  void push(Model& model, std::size_t node, double force) const { model.push_contact_point(node, axis, sign * force); }
};

/// The grains are on the side to which the normal points.
struct Plane {
  static constexpr bool curved = false;
  AxisNormal normal; ///< towards the grains
  double position;   ///< mm, along the axis

  bool may_touch(const Bounds& bounds) const {
    return normal.sign > 0 ? bounds.low[normal.axis] < position : bounds.high[normal.axis] > position;
  }
  /// `point(axis)` gives a coordinate, mm.
  template <class Point>
  RigidGap<AxisNormal> gap(const Point& point) const {
    return {wall_gap(point(normal.axis), position, normal.sign), normal};
  }
};

} // namespace mpfem
