#pragma once
// Friction of a contact point between two meshed surfaces: where it is anchored, how the anchor slips, its force.
//
// The anchor is a facet of the other surface with weights. Slip puts it onto the plane of the closest facet, where its
// weights may be a little outside [0, 1]: the chord is at most mu times the penetration.
//
// With a bond, the intact share 1 - D of the point carries the bond and the damaged share D rubs. The stiffness of
// friction is what the bond leaves of the penalty (solver/physics/bond_kinematics.hpp), D k where the bond has the
// stiffness of the penalty, and its bound is D mu N. Area that damage adds starts unloaded: the friction force stays
// the same, so the anchor moves closer. Damage then dissipates exactly G^c at any pressure.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/physics/friction.hpp"
#include "solver/physics/gap.hpp"

namespace mpfem {

/// The friction of one contact point.
struct PointFriction {
  std::int32_t facet = -1;         ///< of the anchor, -1: none
  double weight1 = 0, weight2 = 0; ///< shape functions of the facet's second and third node
  double stiffness = 0;            ///< k_t at the last time level, N/mm
  Vector3<double> force{0, 0, 0};  ///< N, of the node on the anchor at the last time level
  double stored = 0;               ///< mJ, at the last time level
  double dissipated = 0;           ///< mJ, by this point so far; kept when it opens
  bool exists() const { return facet >= 0; }
};

/// A node inside another surface.
struct ClosedPoint {
  Vector3<double> node;               ///< mm
  std::int32_t facet;                 ///< the closest
  const Vector3<double> (&corner)[3]; ///< mm, of the closest facet
  const ClosestPoint<double>& closest;
  double depth;          ///< |node - closest point|, mm
  Vector3<double> moved; ///< mm, of the node against the facet in the last step; read where it closes
};

/// The result of friction at one point in one step.
struct FrictionStep {
  Vector3<double> reach;  ///< mm, from the anchor to the node: times -k_t the force on the node
  double stored = 0;      ///< mJ
  double dissipated = 0;  ///< mJ, since the time level before
  bool on_closest = true; ///< the anchor is on the closest facet
};

/// Anchors a point on the plane of a facet, beneath or above `place` (mm).
inline void anchor_at(PointFriction& point, std::int32_t facet, const Vector3<double> (&corner)[3],
                      const Vector3<double>& place) {
  const PlaneFoot foot = foot_on_plane(place, corner);
  point.facet = facet;
  point.weight1 = foot.weight1;
  point.weight2 = foot.weight2;
}

/// The part of `vector` perpendicular to `direction`.
inline Vector3<double> part_across(const Vector3<double>& vector, const Vector3<double>& direction) {
  const double square = dot(direction, direction);
  return square > 0 ? vector - (dot(vector, direction) / square) * direction : vector;
}

/// Where a point that has closed in the last step came through the surface, mm.
inline Vector3<double> entry_point(const ClosedPoint& at) {
  const Vector3<double> offset = at.node - at.closest.point;
  const double share = share_inside(at.depth, dot(at.moved, offset) / at.depth);
  return at.closest.point - share * part_across(at.moved, offset);
}

/// The point's spring in a step. `friction`: mu times the share of the point that rubs; `penalty` k and `stiffness` k_t
/// in N/mm.
inline FrictionSpring<double> friction_spring(const PointFriction& point, double friction, double penalty,
                                              double stiffness) {
  return {friction, penalty, point.exists() ? point.stiffness : stiffness, stiffness};
}

/// Updates the friction of a closed point to this time level. `anchor` holds the corners (mm) of its anchor's facet; it
/// is not read if the point has no anchor yet. Then the point is anchored where it came in.
inline FrictionStep advance_friction(PointFriction& point, const FrictionSpring<double>& spring, const ClosedPoint& at,
                                     const Vector3<double> (&anchor)[3]) {
  const Vector3<double> closest = at.closest.point;
  const bool fresh = !point.exists();
  const Vector3<double> before = fresh ? entry_point(at) : facet_point(anchor, point.weight1, point.weight2);
  const Vector3<double> trial = at.node - before;
  const double displacement = std::sqrt(std::max(dot(trial, trial) - at.depth * at.depth, 0.0));
  const auto [kept, left] = displacement_shares(spring, displacement, at.depth);
  FrictionStep step;
  step.on_closest = fresh || left < 1;
  if (step.on_closest)
    anchor_at(point, at.facet, at.corner, closest - left * part_across(closest - before, at.node - closest));
  const Vector3<double> now = step.on_closest ? facet_point(at.corner, point.weight1, point.weight2) : before;
  step.reach = at.node - now;
  const Vector3<double> force = spring.stiffness * step.reach;
  step.stored = stick_energy(spring.stiffness, dot(step.reach, step.reach), at.depth);
  // Central differences do the work of the whole step in which a point closes, not only of its part inside.
  const Vector3<double> start = fresh ? closest - part_across(at.moved, at.node - closest) : before;
  step.dissipated = friction_loss(spring, kept, closest - before, point.force, force, now - start);
  point.stiffness = spring.stiffness;
  point.force = force;
  point.stored = step.stored;
  point.dissipated += step.dissipated;
  return step;
}

/// The point without an anchor.
inline PointFriction without_anchor(const PointFriction& point) {
  PointFriction free;
  free.dissipated = point.dissipated;
  return free;
}

/// Energy (mJ) that is lost when a point opens: its anchor slips all the way to the closest point. `anchor` as above.
inline double release(PointFriction& point, const Vector3<double>& closest, const Vector3<double> (&anchor)[3]) {
  const Vector3<double> slip = closest - facet_point(anchor, point.weight1, point.weight2);
  const double lost = slip_dissipation(point.force, Vector3<double>{0, 0, 0}, slip);
  point = without_anchor(point);
  point.dissipated += lost;
  return lost;
}

} // namespace mpfem
