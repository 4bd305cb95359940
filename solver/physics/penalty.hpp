#pragma once
// Penalty contact of a node with a surface, at one point.
//
// Two surfaces that overlap by g push each other apart with the pressure p = K g. K has the unit MPa/mm and is a
// multiple of E/h (Young's modulus over element size), so that a facet yields about as much as the element beneath it:
//   K = factor E / h, factor 10 by default (Ku, Zhao, Mollon and Zhao, section 2).
// A node with the tributary area A of the reference state then carries the force k g with k = K A. The reference area
// makes the energy k g^2 / 2 an exact potential of this force; with the current area it would not be one.

#include <cmath>

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Penalty K (MPa/mm) of a grain. `factor` > 0; `youngs` MPa, > 0; `element_size` mm, > 0.
inline double penalty_stiffness(double factor, double youngs, double element_size) {
  return factor * youngs / element_size;
}

/// Stiffness (MPa/mm) of one of the two passes, nodes of A against facets of B and nodes of B against facets of A, in
/// the contact of two grains with the penalties `first` and `second` (MPa/mm). It is half of their harmonic mean, as of
/// two springs in series. Both passes together have the harmonic mean.
inline double pass_stiffness(double first, double second) {
  return first * second / (first + second);
}

/// Force (N) on a node at `offset` (mm) from the closest point of the surface that it has entered; `stiffness` k in
/// N/mm. The surface takes the opposite force at the closest point.
template <class S>
Vector3<S> penalty_force(const S& stiffness, const Vector3<S>& offset) {
  return -(stiffness * offset);
}

/// Energy (mJ) of that spring. `overlap` in mm, the length of the offset; `stiffness` k in N/mm.
template <class S>
S penalty_energy(const S& stiffness, const S& overlap) {
  return S(0.5) * stiffness * overlap * overlap;
}

/// Bound of what one contact point adds to the frequency squared of its nodes, as a stiffness (N/mm) of the node
/// itself; a facet's node c takes |w_c| of it. With the gap g = n.(u - sum w_c u_c), W the sum of the magnitudes of the
/// weights and Cauchy's inequality
///   k g^2 <= k (1 + W) (u^2 + sum |w_c| u_c^2).
/// W is 1 for a point inside its facet; the point beneath an opened bond may lie outside, with larger weights.
inline double contact_stiffness_bound(double stiffness, double weight0, double weight1, double weight2) {
  return (1.0 + std::abs(weight0) + std::abs(weight1) + std::abs(weight2)) * stiffness;
}

/// What contact usually adds to the frequency squared (1/s^2) of a surface node with `inverse_mass` (1/tonne): twice a
/// `stiffness` (N/mm), as contact_stiffness_bound() with W = 1. With the stiffness K/2 A of a contact point between
/// equal grains this is the part of that point alone. With K A it also has the node's share as a corner of facets that
/// other points touch, by symmetry of the same size, and is more than what a wall adds, K A.
inline double expected_contact_rate(double stiffness, double inverse_mass) {
  return 2.0 * stiffness * inverse_mass;
}

} // namespace mpfem
