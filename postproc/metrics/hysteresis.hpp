#pragma once
// Isotropic load cycles: area of the loops, drift of the density, dissipation.

#include <optional>
#include <span>
#include <vector>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Rows of a cycle: from a lowest stress through the highest to the next lowest.
struct CycleRows {
  std::size_t begin = 0, top = 0, end = 0;
  bool whole = true; ///< false: a first loading that begins between the cycles' stresses, and its unloading
};

/// Cycles of a curve of the mean stress. At a turning point the stress turns back by more than a fifth of its whole
/// range, so that noise makes no turning points. The first row is a lowest point where the stress rises from it. An
/// incomplete cycle at the end is left out. A first loading that rises by less than four fifths of the fall after it is
/// in the list, with `whole` false.
std::vector<CycleRows> find_cycles(std::span<const double> mean_stress);

/// Area of the loop: integral of (p - p_0) over the volumetric strain (trapezoids), MPa = mJ/mm^3. p_0 is the mean of
/// both lowest stresses, so that a drift of the strain does not add to the area where the loop is not closed.
double loop_area(std::span<const double> mean_stress, std::span<const double> volumetric_strain, CycleRows cycle);

/// Results of one cycle.
struct CycleResult {
  CycleRows rows;
  double lowest_stress = 0, highest_stress = 0;   ///< MPa
  double area = 0, area_uncertainty = 0;          ///< MPa; uncertainty: change if every second row is left out
  double density_at_low = 0, density_at_high = 0; ///< at the stresses that all cycles reach (see hysteresis)
  double density_at_low_uncertainty = 0, density_at_high_uncertainty = 0; ///< interpolation_uncertainty
  double plastic = 0, damage = 0;                                         ///< mJ, dissipated in the cycle
  /// mJ: turning_point_uncertainty of both ends, added; for `plastic` in quadrature with the change of the ledger's
  /// residual.
  double plastic_uncertainty = 0, damage_uncertainty = 0;
};

/// Mean change of the relative density from cycle to cycle.
struct Drift {
  double value, uncertainty; ///< uncertainty: from those of the first and last density
};

/// Results of all cycles of a curve.
struct Hysteresis {
  std::vector<CycleResult> cycles; ///< the first may be a loading that is not whole; drifts are of whole ones
  double low_stress = 0;  ///< MPa: highest of the cycles' end stresses; density at low stress is read here, unloading
  double high_stress = 0; ///< MPa: lowest of the highest stresses; densities at high stress are read here, on loading
  std::optional<Drift> drift_at_low, drift_at_high; ///< of the density at low and at high stress; none for one cycle
};

/// Curves row by row: MPa, 1 (compression positive), 1, mJ, mJ, mJ. Densities are read at common stresses because
/// turning points overshoot by varying amounts, which would look like a drift. Throws InputError naming `path` where
/// there is no whole cycle.
Hysteresis hysteresis(std::span<const double> mean_stress, std::span<const double> volumetric_strain,
                      std::span<const double> relative_density, std::span<const double> plastic_dissipation,
                      std::span<const double> damage_dissipation, std::span<const double> energy_residual,
                      const std::string& path);

/// One row per cycle: its number from 1 (0: a first loading that is not whole), rows of the history (`first_row` is
/// that of the curves' first), stresses (MPa), area (MPa), densities, dissipation (mJ), uncertainties, number of cycles
/// before it, and change of the densities from the cycle before.
std::vector<Column> cycle_table(const Hysteresis& hysteresis, std::size_t first_row);

/// The measured number, and the table of all cycles.
struct HysteresisMeasurement {
  Measurement measurement;
  std::vector<Column> cycles;
};

/// Measures stage `number` (default: the last stress_cycles, otherwise all rows). The value is the area of the last
/// cycle's loop (MPa). Throws InputError.
HysteresisMeasurement measure_hysteresis(const schema::FileReader& file, std::optional<int> number);

} // namespace mpfem
