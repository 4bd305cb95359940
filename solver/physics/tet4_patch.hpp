#pragma once
// Patches of tetrahedra with one pressure (de Souza Neto, Pires & Owen 2005, "F-bar-based linear triangles and
// tetrahedra for finite strain analysis of nearly incompressible solids. Part I"): a cure for volumetric locking.
//
// Eight tets that lie together share one volume ratio J_P = V_P / V0_P, sums over the patch, and so one mean stress K
// ln J_P. This is the derivative of the energy   sum over patches of V0_P U(J_P),   U'(J) = K ln J, since the force of
// a uniform pressure on a tet is the gradient of its volume. It is an exact potential, like that of the plain tet, with
// an eighth of its constraints. By Cauchy's inequality it is never stiffer than the plain tet, so the plain tet's
// stable step holds. Deviator, plasticity and bulk viscosity stay the tet's own.

#include "solver/physics/elasticity.hpp"

namespace mpfem {

/// Tets of a patch. Eight is the smallest number that the authors recommend for tetrahedra.
inline constexpr int patch_tets = 8;

/// Elastic mean stress (MPa) of a patch from its volume (mm^3) and 1 over its reference volume (1/mm^3).
inline double patch_mean_stress(const ElasticModuli& moduli, double volume, double inverse_reference_volume) {
  return mean_stress(moduli, volume * inverse_reference_volume);
}

/// Volumetric energy (mJ) of a patch.
inline double patch_volumetric_energy(const ElasticModuli& moduli, double volume, double inverse_reference_volume) {
  return volumetric_energy(moduli, volume * inverse_reference_volume) / inverse_reference_volume;
}

} // namespace mpfem
