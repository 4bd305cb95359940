#pragma once
// The largest eigenfrequency of a whole grain, by Lanczos' method (Golub & Van Loan, Matrix Computations, section
// 10.1). It decides the stable step. The bound of single tets (solver/physics/stable_step.hpp) is proven and cheap, but
// no grain vibrates as its worst tet would by itself: neighbours share their masses, and their highest modes do not fit
// together.

#include <span>

#include "solver/model/model.hpp"

namespace mpfem {

/// A frequency, and how well it is known.
struct LargestFrequency {
  double squared;  ///< 1/s^2: Lanczos' value plus its residual, within which an eigenvalue lies
  double residual; ///< 1/s^2, included in `squared`
  int iterations;
};

/// Largest eigenvalue of M^-1 (K + 2/dt C) + D of a grain: K its elastic stiffness in the current shape, C its bulk
/// viscosity, D = `nodal_stiffness_rate` (1/s^2, [nodes of the model]) a bound of contact as a diagonal matrix. With
/// lagged viscous forces, central differences are stable if it is at most 4/dt^2. `step` (s) may be any dt not longer
/// than the one sought: viscosity is then overestimated. The elastic stiffness is that of plain tets; tets with shared
/// pressures are not stiffer. `strain_rate` (1/s) bounds the volumetric rate for quadratic viscosity.
LargestFrequency largest_frequency(const Model& model, int grain, std::span<const double> nodal_stiffness_rate,
                                   double step, double strain_rate);

} // namespace mpfem
