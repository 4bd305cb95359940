#pragma once
// The element pass of one grain: stress update and internal forces of all its tetrahedra.

#include "solver/model/model.hpp"

namespace mpfem {

/// Sums of one grain over one element pass.
struct ElementSums {
  double plastic_work = 0;   ///< mJ, in this step
  double viscous_work = 0;   ///< mJ, in this step
  double largest_strain = 0; ///< largest norm of a strain increment
  bool admissible = true;    ///< false where a tet is inverted or a value is not finite
};

/// Advances stresses over the step that led to the present positions and writes the internal forces (N) of the grain's
/// nodes to model.force, overwriting it. model.velocity is that of the half step just done, `time_step` its length in s.
ElementSums element_forces(Model& model, int grain, double time_step);

/// Elastic energy of a grain, mJ.
double elastic_energy(const Model& model, int grain);

/// Current volume of a grain, mm^3.
double current_volume(const Model& model, int grain);

/// Index in the packing file of the first inverted (or not finite) tet of a grain, and its volume ratio.
struct BadTet {
  std::int32_t file_tet = -1;
  double volume_ratio = 0;
};
BadTet find_bad_tet(const Model& model, int grain);

/// Stable step of a grain's tets, damping by bulk viscosity included; sets the tets' length. Viscosity damps a tet by up to
/// b1 (lambda + 2 mu) / bulk modulus of the critical, where all of its motion is a change of volume. `nodal_stiffness_rate`
/// holds for each node the contact's share kappa/m of the frequency squared (1/s^2) or is empty. By the element
/// eigenvalue inequality omega^2 <= max over tets of (omega_e^2 + max over its nodes of kappa/m).
/// `strain_rate` 1/s bounds the volumetric rate for the quadratic viscosity.
struct StableStep {
  double step;            ///< s
  double step_no_contact; ///< s, of the elements alone
  double growth; ///< largest factor by which a tet's frequency squared has grown since the call before, at least 1
};
StableStep stable_step(Model& model, int grain, std::span<const double> nodal_stiffness_rate, double strain_rate);

/// Fields of one tet for output, in file order of the whole packing.
struct TetFields {
  std::vector<float> von_mises; ///< MPa
  std::vector<float> pressure;  ///< MPa, compression positive
  std::vector<float> plastic_strain;
};
TetFields tet_fields(const Model& model);

} // namespace mpfem
