#pragma once
// Average nodal pressure (Bonet & Burton 1998) for the linear tetrahedron: a cure for volumetric locking.
//
// A node a owns a quarter of the volume of every tet around it: V_a = sum V_e / 4, V0_a in the reference state. The
// volumetric energy is   sum over nodes of V0_a U(J_a),   J_a = V_a / V0_a,   U'(J) = K ln J,   whose derivative with
// respect to the nodes' positions gives every tet the mean of its four nodes' K ln J_a as its mean stress. It is an
// exact potential, like that of the plain tet, with one constraint per node instead of one per tet (five to six times
// as many). By Jensen's inequality it is never stiffer than the plain tet, so the plain tet's stable step holds.
// Deviator, plasticity and bulk viscosity stay the tet's own.

#include "solver/physics/elasticity.hpp"

namespace mpfem {

/// Elastic mean stress (MPa) around a node from its volume (mm^3) and 1 over its reference volume (1/mm^3).
template <class S>
S nodal_mean_stress(const ElasticModuli& moduli, const S& volume, const S& inverse_reference_volume) {
  return mean_stress(moduli, volume * inverse_reference_volume);
}

/// Volumetric energy (mJ) around a node.
template <class S>
S nodal_volumetric_energy(const ElasticModuli& moduli, const S& volume, const S& inverse_reference_volume) {
  return volumetric_energy(moduli, volume * inverse_reference_volume) / inverse_reference_volume;
}

/// Elastic mean stress (MPa) of a tet from those of its nodes.
template <class S>
S mean_of_nodes(const S& a, const S& b, const S& c, const S& d) {
  return S(0.25) * ((a + b) + (c + d));
}

} // namespace mpfem
