#pragma once
// Stresses and strains of the packing, from what a stage observes.

#include "solver/run/stages/stage_control.hpp"

namespace mpfem {

/// Stresses in MPa, compression positive; logarithmic strains since the stage began, compression positive.
struct ObservedSample {
  double time = 0, step = 0;                                           ///< s
  double rate_factor = 1;                                              ///< current speed over the stage's own
  std::array<double, 3> length{}, area{}, force{}, stress{}, strain{}; ///< mm, mm^2, N, MPa, 1, of each axis
  double mean_stress = 0, deviatoric_stress = 0;
  double relative_density = 0;
  double plastic_dissipation = 0; ///< mJ
};

/// `start_length` in mm, of the cell when the stage began; `solid_volume` in mm^3.
ObservedSample observe_sample(const StageObservation& seen, const std::array<double, 3>& start_length,
                              double solid_volume);

} // namespace mpfem
