#pragma once
// Rigid surfaces of tools as signed distances: oriented plane, cylinder with rounded ends, sphere, cone, triangles.
//
// Each is a RigidSurface (rigid_surface.hpp) in its tool's own frame, which shifts when the tool moves. The distance is
// positive where the grains are, and its gradient is the normal.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "solver/boundary/rigid_surface.hpp"
#include "surfaces/triangulated_surface.hpp"

namespace mpfem {

/// Any unit direction.
struct FreeNormal {
  Vector3<double> direction;
  Vector3<double> vector() const { return direction; }
  void push(Model& model, std::size_t node, double force) const {
    model.push_contact_point(node, 0, force * direction.x);
    model.push_contact_point(node, 1, force * direction.y);
    model.push_contact_point(node, 2, force * direction.z);
  }
};

/// Where a point lies relative to an axis.
struct AxialPosition {
  double along;           ///< mm, from the reference point
  double radius;          ///< mm, from the axis
  Vector3<double> radial; ///< unit vector away from the axis; 0 on it

  AxialPosition(const Vector3<double>& from_reference, std::size_t axis) {
    std::array<double, 3> v{from_reference.x, from_reference.y, from_reference.z};
    along = v[axis];
    v[axis] = 0;
    radius = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double inverse = radius > 0 ? 1.0 / radius : 0.0;
    radial = {inverse * v[0], inverse * v[1], inverse * v[2]};
  }
};

/// The place (mm) of a point that gives its coordinates one by one.
template <class Point>
Vector3<double> place_of(const Point& point) {
  return {point(0), point(1), point(2)};
}

/// Nearest and farthest distance (mm) of a box's points from an axis or, where `axis` is 3, from a point.
struct DistanceRange {
  double nearest, farthest;
  DistanceRange(const Bounds& bounds, const Vector3<double>& reference, std::size_t axis) {
    double near = 0, far = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == axis) continue;
      const double low = bounds.low[i] - reference[i], high = bounds.high[i] - reference[i];
      const double closest = std::max({low, -high, 0.0}), widest = std::max(-low, high);
      near += closest * closest;
      far += widest * widest;
    }
    nearest = std::sqrt(near);
    farthest = std::sqrt(far);
  }
};

/// A plane in any direction; the grains are where its normal points.
struct OrientedPlane {
  static constexpr bool curved = false;
  Vector3<double> point;  ///< mm
  Vector3<double> normal; ///< unit vector towards the grains

  bool may_touch(const Bounds& b) const {
    const double lowest = std::min(normal.x * b.low[0], normal.x * b.high[0]) +
                          std::min(normal.y * b.low[1], normal.y * b.high[1]) +
                          std::min(normal.z * b.low[2], normal.z * b.high[2]);
    return lowest < dot(normal, point);
  }
  template <class Point>
  RigidGap<FreeNormal> gap(const Point& x) const {
    return {dot(normal, place_of(x) - point), {normal}};
  }
};

/// A die (the material around a bore) or a rod, with rounded edges at the ends. In the plane of radius and axis, each
/// is a rectangle with round corners, whose signed distance is exact.
struct CylinderSurface {
  static constexpr bool curved = true;
  std::size_t axis;
  Vector3<double> centre; ///< mm, on the axis, midway between the ends
  double radius;          ///< mm
  bool inside;            ///< grains are inside
  double half_length;     ///< mm; infinite where the cylinder is endless
  double rounding;        ///< mm

  bool may_touch(const Bounds& b) const {
    const double middle = centre[axis];
    if (b.low[axis] > middle + half_length || b.high[axis] < middle - half_length) return false;
    const DistanceRange range(b, centre, axis);
    return inside ? range.farthest > radius : range.nearest < radius;
  }
  template <class Point>
  RigidGap<FreeNormal> gap(const Point& x) const {
    const AxialPosition p(place_of(x) - centre, axis);
    const double sign = inside ? -1.0 : 1.0; // of the way out of the material along the radius
    // How far beyond the rectangle's straight edges, drawn in by the rounding.
    const double across = sign * (p.radius - radius) + rounding;
    const double beyond = std::abs(p.along) - (half_length - rounding);
    const Vector3<double> outwards = sign * p.radial, endwards = along_axis(axis, p.along < 0 ? -1.0 : 1.0);
    if (across > 0 && beyond > 0) {
      const double length = std::sqrt(across * across + beyond * beyond);
      return {length - rounding, {(across / length) * outwards + (beyond / length) * endwards}};
    }
    if (across > beyond) return {across - rounding, {outwards}};
    return {beyond - rounding, {endwards}};
  }
};

/// A ball, or the material around a ball-shaped hollow.
struct SphereSurface {
  static constexpr bool curved = true;
  Vector3<double> centre; ///< mm
  double radius;          ///< mm
  bool inside;            ///< grains are inside

  bool may_touch(const Bounds& b) const {
    const DistanceRange range(b, centre, 3);
    return inside ? range.farthest > radius : range.nearest < radius;
  }
  template <class Point>
  RigidGap<FreeNormal> gap(const Point& x) const {
    const Vector3<double> from_centre = place_of(x) - centre;
    const double distance = std::sqrt(dot(from_centre, from_centre));
    const double sign = inside ? -1.0 : 1.0, inverse = distance > 0 ? sign / distance : 0.0;
    return {sign * (distance - radius), {inverse * from_centre}};
  }
};

/// The distance is that from the cone's side or, beyond its apex, from the side extended.
struct ConeSurface {
  static constexpr bool curved = true;
  std::size_t axis;
  double direction;     ///< 1 or -1, of the opening along the axis
  Vector3<double> apex; ///< mm
  double sine, cosine;  ///< of the half angle
  bool inside;          ///< grains are inside

  /// The region inside a cone is convex, so that a block lies in it if its corners do.
  bool may_touch(const Bounds& b) const {
    if (!inside) return true;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto coordinate = [&](std::size_t i) { return ((corner >> i) & 1U) != 0 ? b.high[i] : b.low[i]; };
      if (gap(coordinate).distance < 0) return true;
    }
    return false;
  }
  template <class Point>
  RigidGap<FreeNormal> gap(const Point& x) const {
    const AxialPosition p(place_of(x) - apex, axis);
    const double sign = inside ? 1.0 : -1.0;
    return {sign * (direction * p.along * sine - p.radius * cosine),
            {sign * (along_axis(axis, direction * sine) - cosine * p.radial)}};
  }
};

/// A closed surface of triangles. Many tools may share one.
struct BodySurface {
  static constexpr bool curved = true;
  std::shared_ptr<const TriangulatedSurface> triangles;
  Vector3<double> centre;                     ///< mm, the middle of its bounds
  double reach;                               ///< mm: up to so far in front, distances and normals are exact
  std::shared_ptr<const TriangleMesh> mesh{}; ///< what the triangles were made from, for pictures

  bool may_touch(const Bounds& b) const { return triangles->may_touch(b); }
  template <class Point>
  RigidGap<FreeNormal> gap(const Point& x) const {
    return with_free_normal(triangles->gap({x(0), x(1), x(2)}, reach));
  }
  /// The same, exact at any distance in front.
  template <class Point>
  RigidGap<FreeNormal> exact_gap(const Point& x) const {
    return with_free_normal(triangles->gap({x(0), x(1), x(2)}));
  }

private:
  static RigidGap<FreeNormal> with_free_normal(const SurfaceGap& gap) {
    return {gap.distance, {{gap.normal[0], gap.normal[1], gap.normal[2]}}};
  }
};

/// A surface whose tool has moved by `by` (mm).
template <class Surface>
struct Shifted {
  static constexpr bool curved = Surface::curved;
  const Surface& surface;
  Vector3<double> by;

  bool may_touch(const Bounds& bounds) const {
    Bounds local = bounds;
    for (std::size_t axis = 0; axis < 3; ++axis) local.low[axis] -= by[axis], local.high[axis] -= by[axis];
    return surface.may_touch(local);
  }
  template <class Point>
  auto gap(const Point& point) const {
    return surface.gap(shifted(point));
  }
  template <class Point>
  auto exact_gap(const Point& point) const {
    return gap_at_any_distance(surface, shifted(point));
  }

private:
  /// A point as seen from the surface where it stood at the start.
  template <class Point>
  auto shifted(const Point& point) const {
    return [&point, shift = std::array{by.x, by.y, by.z}](std::size_t axis) { return point(axis) - shift[axis]; };
  }
};

} // namespace mpfem
