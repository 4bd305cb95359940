#pragma once
// Coulomb friction at one contact point: a stick spring whose anchor slips.
//
// x is the node, c the closest point of the other surface, g = |x - c| the depth of the node inside it. The anchor a is
// a material point of that surface (of a wall: a point of the wall). A spring of stiffness k_t (N/mm) between x and a
// stores only the tangential part of its energy,
//   k_t (|x - a|^2 - g^2)/2 = k_t e^2/2,   e the tangential displacement of the spring.
// The penalty adds k g^2/2. With k_t = k, as here, c drops out of the sum: one spring k from the node to its anchor is
// both the push and the friction. Force and reaction act along one line between material points, so that momentum and
// angular momentum are conserved exactly, and a rotation of both bodies changes nothing.
//
// Coulomb's law |t| <= mu N with N = k g bounds this elastic displacement: e <= mu k g/k_t. Beyond that bound, the
// anchor slips towards c until it holds (return mapping: Wriggers, Computational Contact Mechanics, 2006, section
// 10.5). N is taken at the same time level.

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Largest tangential displacement e (mm) that friction can hold. `friction` mu >= 0; `penalty` k and `stiffness` k_t >
/// 0, N/mm; `depth` g >= 0, mm.
template <class S>
S largest_tangential_displacement(const S& friction, const S& penalty, const S& stiffness, const S& depth) {
  return friction * penalty * depth / stiffness;
}

/// Share of a tangential displacement (mm) that is left after slip: 1 if the point sticks. `largest` (mm): what
/// friction can hold.
template <class S>
S share_left_by_slip(const S& displacement, const S& largest) {
  return select(displacement > largest, largest / max(displacement, S(1e-300)), S(1.0));
}

/// Share of the tangential displacement with which the friction force stays the same when the stiffness rises from
/// `before` to `now` (N/mm): area that begins to rub starts unloaded.
template <class S>
S share_left_by_new_area(const S& before, const S& now) {
  return select(before < now, before / max(now, S(1e-300)), S(1.0));
}

/// The spring between a point's node and its anchor: constants of one step.
template <class S>
struct FrictionSpring {
  S friction;         ///< mu times the share of the point that rubs
  S penalty;          ///< k, N/mm
  S stiffness_before; ///< k_t at the time level before, N/mm; that of now if the point has just closed
  S stiffness;        ///< k_t now, N/mm, >= 0
};

/// What is left of a tangential displacement: `kept` once area that begins to rub is unloaded, `left` after slip, too.
template <class S>
struct DisplacementShares {
  S kept, left;
};

/// The update of a stick spring. `displacement` e and `depth` g in mm, of the trial state.
template <class S>
DisplacementShares<S> displacement_shares(const FrictionSpring<S>& spring, const S& displacement, const S& depth) {
  const S kept = share_left_by_new_area(spring.stiffness_before, spring.stiffness);
  const S stiffness = max(spring.stiffness, S(1e-300));
  const S largest = select(spring.stiffness > S(0.0),
                           largest_tangential_displacement(spring.friction, spring.penalty, stiffness, depth), S(0.0));
  return {kept, kept * share_left_by_slip(kept * displacement, largest)};
}

/// Share of a point's motion in the last step that it made inside the surface, if it was open before. `depth` g >= 0;
/// `closing`: how much the step closed the gap; both in mm. The point is anchored where it came in. Otherwise a contact
/// of few steps, as in chattering, would have no friction in its first step.
template <class S>
S share_inside(const S& depth, const S& closing) {
  return select(closing > depth, depth / max(closing, S(1e-300)), select(closing > S(0.0), S(1.0), S(0.0)));
}

/// Stored energy (mJ) of the stick spring. `stiffness` k_t, N/mm; `square` |x - a|^2 and `depth` g, mm.
template <class S>
S stick_energy(const S& stiffness, const S& square, const S& depth) {
  return S(0.5) * stiffness * (square - depth * depth);
}

/// Energy (mJ) that a slip of the anchor (mm) in one step dissipates. `before` and `now` are the forces (N) on the
/// anchor at the time level before and, after the slip, at this one. Central differences do work against their mean.
/// (The energy of the trial state less that of the returned state would be larger, by the fraction k |slip|/(2 mu N).)
template <class S>
S slip_dissipation(const Vector3<S>& before, const Vector3<S>& now, const Vector3<S>& slip) {
  return S(0.5) * dot(before + now, slip);
}

/// Energy (mJ) lost in one step of a stick spring: by the unloading of area that begins to rub, and by slip.
/// `displacement` (mm): tangential, from the anchor before to the closest point; `slip` (mm): of the anchor, and of a
/// point that has just closed its motion along the surface before it came in; forces (N) as of slip_dissipation().
template <class S>
S friction_loss(const FrictionSpring<S>& spring, const S& kept, const Vector3<S>& displacement,
                const Vector3<S>& force_before, const Vector3<S>& force, const Vector3<S>& slip) {
  const Vector3<S> unloaded = (S(1.0) - kept) * displacement;
  return S(0.5) * spring.stiffness_before * dot(displacement, unloaded) +
         slip_dissipation(force_before, force, slip - unloaded);
}

} // namespace mpfem
