#pragma once
// Where damage begins to grow in a test.

#include <optional>
#include <vector>

#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

/// Onset of damage: the steepest tangent of the damage dissipation against axial strain, up to the peak of the stress,
/// extended back to the level at the stage's beginning.
struct DamageOnset {
  double strain = 0, stress = 0; ///< 1, MPa
  /// Of the strain: the effect of the noise of the damage on the tangent and on the level, to first order (95 %), plus
  /// the shift of the onset with a tangent over twice the strain. Of the stress: half of its change within that strain
  /// and its ringing, in quadrature.
  double strain_uncertainty = 0, stress_uncertainty = 0;
};

/// `smooth` and `raw`: the axial stress or q (MPa), one value per row, smoothed and as recorded; `peak`: the row of its
/// largest value. Empty where damage does not grow up to there.
std::optional<DamageOnset> damage_onset(const StageCurve& curve, const std::vector<double>& smooth,
                                        const std::vector<double>& raw, std::size_t peak);

/// Where the strain is reached, between rows 0 and `last`; the nearest of these rows where it lies outside.
Crossing at_strain(const std::vector<double>& strain, double target, std::size_t last);

/// Half of the change of a column between the strains `at` ± `reach`, in the column's unit.
double half_change(const std::vector<double>& column, const std::vector<double>& strain, double at, double reach);

} // namespace mpfem
