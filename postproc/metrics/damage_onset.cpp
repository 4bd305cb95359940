#include "postproc/metrics/damage_onset.hpp"

#include <algorithm>
#include <cmath>

#include "postproc/run_data/ringing.hpp"
#include "postproc/run_data/smoothing.hpp"

namespace mpfem {

namespace {

/// A tangent of the damage dissipation against axial strain, over a strain of `span` around `row`.
struct Tangent {
  std::size_t row = 0;
  double span = 0, slope = 0; ///< 1, mJ
  double onset = 0;           ///< strain at which it meets the level at the stage's beginning
};

/// The steepest one up to the peak, always over twice `reach` of strain: while the walls start, rows lie so close
/// together that the slope between neighbours is mostly noise.
std::optional<Tangent> steepest_tangent(const StageCurve& c, const std::vector<double>& damage, std::size_t peak,
                                        double reach) {
  Tangent steepest;
  for (std::size_t row = 0; row <= peak; ++row) {
    std::size_t low = row, high = row;
    while (low > 0 && c.axial_strain[row] - c.axial_strain[low] < reach) --low;
    while (high < peak && c.axial_strain[high] - c.axial_strain[row] < reach) ++high;
    const double strain = c.axial_strain[high] - c.axial_strain[low];
    if (strain < 2 * reach) continue; // too close to either end
    if (const double slope = (damage[high] - damage[low]) / strain; slope > steepest.slope)
      steepest = {row, strain, slope, 0};
  }
  if (!(steepest.slope > 0)) return {};
  const double grown = damage[steepest.row] - c.damage_dissipation.front();
  steepest.onset = std::max(0.0, c.axial_strain[steepest.row] - grown / steepest.slope);
  return steepest;
}

} // namespace

Crossing at_strain(const std::vector<double>& strain, double target, std::size_t last) {
  std::size_t row = 0;
  while (row < last && strain[row + 1] <= target) ++row;
  if (row == last || target <= strain[row]) return {row, 0};
  return {row, (target - strain[row]) / (strain[row + 1] - strain[row])};
}

double half_change(const std::vector<double>& column, const std::vector<double>& strain, double at, double reach) {
  const std::size_t last = column.size() - 1;
  return 0.5 *
         std::abs(at_strain(strain, at + reach, last).of(column) - at_strain(strain, at - reach, last).of(column));
}

std::optional<DamageOnset> damage_onset(const StageCurve& c, const std::vector<double>& smooth,
                                        const std::vector<double>& raw, std::size_t peak) {
  const std::vector<double> damage = smoothed(c.damage_dissipation);
  const double reach = (c.axial_strain[peak] - c.axial_strain.front()) / 40;
  const auto tangent = steepest_tangent(c, damage, peak, reach), wider = steepest_tangent(c, damage, peak, 2 * reach);
  if (!tangent) return {};
  const Crossing at = at_strain(c.axial_strain, tangent->onset, tangent->row);
  DamageOnset onset;
  onset.strain = tangent->onset;
  onset.stress = at.of(smooth);
  // Error propagation for onset = strain - (damage - level) / slope: the tangent comes from smoothed rows, the level
  // from a single raw row.
  const double left = noise_left_by_parabolas(smoothing_half_rows(c.rows()));
  const double lever = (c.axial_strain[tangent->row] - tangent->onset) / tangent->span;
  const double noise =
      ringing(c.damage_dissipation, tangent->row) / tangent->slope * std::sqrt(1 + left + 2 * left * lever * lever);
  // The steepest of many noisy slopes is too steep, less so over more rows. This is a bias, so it is added to the
  // noise.
  onset.strain_uncertainty = noise + (wider ? std::abs(wider->onset - tangent->onset) : 0.0);
  onset.stress_uncertainty =
      std::hypot(half_change(smooth, c.axial_strain, onset.strain, onset.strain_uncertainty), ringing(raw, at.row));
  return onset;
}

} // namespace mpfem
