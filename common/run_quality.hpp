#pragma once
// What makes the results of a run doubtful, judged from the rows of its history: the same words at the end of a run and
// in `postproc summary`.

#include <span>
#include <string>
#include <vector>

namespace mpfem {

/// Of a row of the history. Energies in mJ, stress in MPa, step in s.
struct QualityRow {
  double external_work = 0, energy_residual = 0, kinetic_energy = 0;
  double internal_energy = 0; ///< of the row's stage (common/stage_energy.hpp)
  double mean_stress = 0;
  double penetration = 0;     ///< over the element size
  double current_density = 0; ///< current volume of the grains over the box's: overlaps count twice
  double time_step = 0;       ///< 0: none yet
};

/// Limits beyond which quality_warnings() warns; the time step warns below its limit.
inline constexpr double doubtful_residual = 0.01; ///< of the largest work
inline constexpr double doubtful_kinetic =
    0.1; ///< of the stage's internal energy, while p is above a tenth of its largest
inline constexpr double doubtful_penetration = 0.2; ///< of the element size
inline constexpr double doubtful_density = 0.995;   ///< no pores are left: beyond, solid is squeezed, or overlaps
inline constexpr double doubtful_step_share = 1e-3; ///< of the first step

/// One line for each thing that makes a run doubtful; empty for a good run.
std::vector<std::string> quality_warnings(std::span<const QualityRow> rows);

} // namespace mpfem
