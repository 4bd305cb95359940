#pragma once
// The stable step of the tets of one grain.

#include <span>

#include "solver/model/model.hpp"

namespace mpfem {

/// The stable step of a grain by its tets.
struct StableStep {
  double step;            ///< s
  double step_no_contact; ///< s, of the elements alone
  double growth; ///< largest factor by which a tet's frequency squared has grown since the previous call, at least 1
};
/// Stable step of a grain's tets, damping by bulk viscosity included; sets the tets' length. Viscosity damps a tet by
/// up to b1 (lambda + 2 mu) / bulk modulus of critical damping, if all of its motion is a change of volume.
/// `nodal_stiffness_rate` holds for each node the contact's share kappa/m of the frequency squared (1/s^2) or is empty.
/// By the element eigenvalue inequality omega^2 <= max over tets of (omega_e^2 + max over its nodes of kappa/m).
/// `strain_rate` 1/s bounds the volumetric rate for the quadratic viscosity.
StableStep stable_step(Model& model, int grain, std::span<const double> nodal_stiffness_rate, double strain_rate);

} // namespace mpfem
