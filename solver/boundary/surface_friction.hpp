#pragma once
// Coulomb friction of a grain's nodes against one rigid surface (solver/physics/friction.hpp).
//
// A node behind the surface has an anchor: a point of the surface, in the surface's own frame, to which a stick spring
// with the stiffness of the penalty is tied. The anchor is forgotten when the node comes in front of the surface.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "solver/boundary/rigid_surface.hpp"
#include "solver/physics/friction.hpp"

namespace mpfem {

/// The stick spring of a node behind a rigid surface.
struct SurfaceAnchor {
  std::int32_t node = 0;
  Vector3<double> place{0, 0, 0}; ///< mm, in the surface's frame
  Vector3<double> force{0, 0, 0}; ///< N, of the node on the anchor at the last time level
};

/// How a surface moved in the step that led to the present.
struct SurfaceMotion {
  Vector3<double> origin{0, 0, 0};   ///< mm, where its frame lies now
  Vector3<double> movement{0, 0, 0}; ///< mm, in the step
  double step = 0;                   ///< s
};

/// What a bond leaves of a point to friction (solver/physics/friction_kinematics.hpp).
struct FrictionShare {
  double share = 1;          ///< D, of the point
  double penalty = 1;        ///< part of the penalty's stiffness
  double penalty_before = 1; ///< the same at the time level before
};

/// The friction of one surface on one grain at one time level.
template <RigidSurface Surface>
class SurfaceFriction {
public:
  /// `before`: the anchors of the time level before, by ascending node.
  SurfaceFriction(Model& model, double friction, const Surface& surface, const SurfaceMotion& motion,
                  const std::vector<SurfaceAnchor>& before)
      : model_(model), friction_(friction), surface_(surface), motion_(motion), next_(before.begin()),
        end_(before.end()) {
    anchors_.reserve(before.size());
  }

  /// Handles a node behind the surface, which penalty and bond together push with `push` (N). To be called by ascending
  /// node. Returns the friction force (N) on the node.
  template <class Gap>
  Vector3<double> add_force(std::size_t node, const Gap& gap, double push, const FrictionShare& of_point = {}) {
    const auto number = static_cast<std::int32_t>(node);
    release_before(number);
    const double depth = -gap.distance;
    const Vector3<double> normal = gap.normal.vector(), closest = closest_point(node, depth, normal);
    const bool known = next_ != end_ && next_->node == number;
    const Entry entry = known ? Entry{} : entry_of(node, depth, normal);
    SurfaceAnchor anchor = known ? *next_++ : SurfaceAnchor{number, closest - entry.inside, {0, 0, 0}};
    const double penalty = push / depth, stiffness = std::max(of_point.penalty, 0.0) * penalty;
    const double before = known ? std::max(of_point.penalty_before, 0.0) * penalty : stiffness;
    const FrictionSpring<double> spring{of_point.share * friction_, penalty, before, stiffness};
    const Vector3<double> displacement = closest - anchor.place; // tangential
    const auto [kept, left] = displacement_shares(spring, norm(displacement), depth);
    const Vector3<double> slip = (1.0 - left) * displacement, force = (left * stiffness) * displacement;
    const Vector3<double> from_anchor = left * displacement - depth * normal;
    energy += stick_energy(stiffness, dot(from_anchor, from_anchor), depth);
    dissipation += friction_loss(spring, kept, displacement, anchor.force, force, slip + entry.before);
    if (left < 1) anchor.place = on_surface(anchor.place + slip);
    anchor.force = force;
    model_.push_contact_point(node, 0, -force.x);
    model_.push_contact_point(node, 1, -force.y);
    model_.push_contact_point(node, 2, -force.z);
    anchors_.push_back(anchor);
    return -force;
  }

  /// The anchors of all nodes that still touch.
  std::vector<SurfaceAnchor> finish() {
    release_before(std::numeric_limits<std::int32_t>::max());
    return std::move(anchors_);
  }

  double energy = 0;      ///< mJ
  double dissipation = 0; ///< mJ

private:
  /// The surface point closest to a node at `depth` (mm) behind it, in the surface's frame.
  Vector3<double> closest_point(std::size_t node, double depth, const Vector3<double>& normal) const {
    return model_.contact_point(node) + depth * normal - motion_.origin;
  }
  /// Puts an anchor back on the surface: a slip along the chord leaves a curved surface by the square of its length.
  Vector3<double> on_surface(const Vector3<double>& place) const {
    if constexpr (requires { requires !Surface::curved; }) {
      return place;
    } else {
      const Vector3<double> at = place + motion_.origin;
      const double x[3] = {at.x, at.y, at.z};
      const auto gap = surface_.gap([&](std::size_t axis) { return x[axis]; });
      return place - gap.distance * gap.normal.vector();
    }
  }
  /// Motion of a node along the surface in the step in which it came through it, mm.
  struct Entry {
    Vector3<double> inside{0, 0, 0}; ///< since then
    Vector3<double> before{0, 0, 0}; ///< until then: central differences do the work of the whole step
  };
  Entry entry_of(std::size_t node, double depth, const Vector3<double>& normal) const {
    const Vector3<double> moved = motion_.step * model_.contact_velocity(node) - motion_.movement;
    const double closing = -dot(moved, normal);
    const double share = share_inside(depth, closing);
    const Vector3<double> along = moved + closing * normal;
    return {share * along, (1.0 - share) * along};
  }
  /// Releases nodes that have come in front of the surface: their anchors slip all the way.
  void release_before(std::int32_t node) {
    for (; next_ != end_ && next_->node < node; ++next_) {
      const auto n = static_cast<std::size_t>(next_->node);
      const auto gap = surface_.gap(NodePoint{model_, n});
      const Vector3<double> slip = closest_point(n, -gap.distance, gap.normal.vector()) - next_->place;
      dissipation += slip_dissipation(next_->force, {0, 0, 0}, slip);
    }
  }

  Model& model_;
  double friction_;
  const Surface& surface_;
  SurfaceMotion motion_;
  std::vector<SurfaceAnchor>::const_iterator next_, end_;
  std::vector<SurfaceAnchor> anchors_;
};

} // namespace mpfem
