#pragma once
// One line of the history; the columns are those of /history in results-schema.

#include <array>

namespace mpfem {

struct HistoryRow {
  double time, step, stage, relative_density, relative_density_current;
  std::array<double, 3> box_lengths;
  std::array<double, 6> wall_stress;
  double mean_stress, deviatoric_stress, axial_strain, volumetric_strain;
  double kinetic_energy, elastic_energy, plastic_dissipation, damage_dissipation, bond_energy, contact_energy,
      viscous_dissipation, damping_dissipation, external_work, energy_residual;
  double contact_area, surface_area, bonded_area, bonds, mean_damage, coordination_number, max_penetration,
      damping_drag_ratio, time_step;
};

} // namespace mpfem
