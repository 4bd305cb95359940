#include "postproc/strength.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/smoothing.hpp"
#include "postproc/statistics.hpp"

namespace mpfem {

namespace {

StrengthTest test_of(const StageCurve& c) {
  if (c.type == "unconfined_compression") return StrengthTest::unconfined;
  if (c.type == "triaxial_compression") return StrengthTest::triaxial;
  return c.unconfined ? StrengthTest::unconfined : StrengthTest::triaxial;
}

std::size_t largest_row(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// Rows to either side of parabolas twice as wide as the smoothing's: they show ringing whose period the narrow ones
/// follow.
std::size_t wide_half_rows(std::size_t rows) {
  const std::size_t half = smoothing_half_rows(rows);
  return rows > 4 * half ? 2 * half : half;
}

/// The rows by which the ringing at `row` is judged.
RowRange ringing_rows(std::size_t row, std::size_t rows) {
  const std::size_t wide = wide_half_rows(rows);
  return {row > wide ? row - wide : 0, std::min(row + wide, rows - 1)};
}

/// Twice the scatter of a column's rows about wide parabolas, near `row`: 95 % of what ringing adds to a row.
double ringing(const std::vector<double>& column, std::size_t row) {
  const RowRange rows = ringing_rows(row, column.size());
  const std::vector<double> calm = local_parabolas(column, wide_half_rows(column.size()));
  double squares = 0;
  for (std::size_t i = rows.first; i <= rows.last; ++i) squares += (column[i] - calm[i]) * (column[i] - calm[i]);
  // A parabola takes three of the rows' degrees of freedom.
  return 2 * std::sqrt(squares / std::max(1.0, static_cast<double>(rows.count()) - 3));
}

/// Where the strain is reached, between rows 0 and `last`; at the ends where it lies beyond.
Crossing at_strain(const std::vector<double>& strain, double target, std::size_t last) {
  std::size_t row = 0;
  while (row < last && strain[row + 1] <= target) ++row;
  if (row == last || target <= strain[row]) return {row, 0};
  return {row, (target - strain[row]) / (strain[row + 1] - strain[row])};
}

/// Half of the change of a column between the strains `strain` ± `reach`.
double half_change(const std::vector<double>& column, const std::vector<double>& strain, double at, double reach) {
  const std::size_t last = column.size() - 1;
  return 0.5 *
         std::abs(at_strain(strain, at + reach, last).of(column) - at_strain(strain, at - reach, last).of(column));
}

/// How far from the peak the smoothed curve may have its true peak: the farther end of the strains about it where the
/// curve is lower by no more than what ringing makes of the difference of two smoothed rows; a row at least.
double strain_uncertainty_of_peak(const std::vector<double>& strain, const std::vector<double>& smooth,
                                  std::size_t peak, double ringing_of_row) {
  const double left = noise_left_by_parabolas(smoothing_half_rows(strain.size()));
  const double lowest = smooth[peak] - ringing_of_row * std::sqrt(2 * left);
  std::size_t low = peak, high = peak;
  while (low > 0 && smooth[low] >= lowest) --low;
  while (high + 1 < smooth.size() && smooth[high] >= lowest) ++high;
  return std::max(strain[peak] - strain[low], strain[high] - strain[peak]);
}

/// A tangent of the damage dissipation against axial strain, over `span` of strain about `row`.
struct Tangent {
  std::size_t row = 0;
  double span = 0, slope = 0; ///< 1, mJ
  double onset = 0;           ///< the strain where it meets the level at the stage's beginning
};

/// The steepest one up to the peak, over twice `reach` of strain, whatever rows fall there: while walls start, rows lie
/// so close that the slope between neighbours is noise over nothing.
std::optional<Tangent> steepest_tangent(const StageCurve& c, const std::vector<double>& damage, std::size_t peak,
                                        double reach) {
  Tangent steepest;
  for (std::size_t row = 0; row <= peak; ++row) {
    std::size_t low = row, high = row;
    while (low > 0 && c.axial_strain[row] - c.axial_strain[low] < reach) --low;
    while (high < peak && c.axial_strain[high] - c.axial_strain[row] < reach) ++high;
    const double strain = c.axial_strain[high] - c.axial_strain[low];
    if (strain < 2 * reach) continue; // at either end
    if (const double slope = (damage[high] - damage[low]) / strain; slope > steepest.slope)
      steepest = {row, strain, slope, 0};
  }
  if (!(steepest.slope > 0)) return {};
  const double grown = damage[steepest.row] - c.damage_dissipation.front();
  steepest.onset = std::max(0.0, c.axial_strain[steepest.row] - grown / steepest.slope);
  return steepest;
}

/// `smooth` and `raw`: the axial stress or q.
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
  // Of onset = strain - (damage - level) / slope: smoothed rows make the tangent, a row as it is the level.
  const double left = noise_left_by_parabolas(smoothing_half_rows(c.rows()));
  const double lever = (c.axial_strain[tangent->row] - tangent->onset) / tangent->span;
  const double noise =
      ringing(c.damage_dissipation, tangent->row) / tangent->slope * std::sqrt(1 + left + 2 * left * lever * lever);
  // The steepest of many noisy slopes is too steep, that over more rows less so: a bias, which noise does not make up
  // for.
  onset.strain_uncertainty = noise + (wider ? std::abs(wider->onset - tangent->onset) : 0.0);
  onset.stress_uncertainty =
      std::hypot(half_change(smooth, c.axial_strain, onset.strain, onset.strain_uncertainty), ringing(raw, at.row));
  return onset;
}

/// Row before the axial strain `strain` is first passed, and how far towards the next.
std::optional<Crossing> reach(const std::vector<double>& strain, double target) {
  for (std::size_t row = 0; row + 1 < strain.size(); ++row)
    if (strain[row + 1] >= target && strain[row] < target)
      return Crossing{row, (target - strain[row]) / (strain[row + 1] - strain[row])};
  return {};
}

} // namespace

Measurement strength(const StageCurve& c, const StrengthRule& rule) {
  const StrengthTest test = rule.test.value_or(test_of(c));
  const bool unconfined = test == StrengthTest::unconfined;
  const std::vector<double>& raw = unconfined ? c.axial_stress : c.deviatoric_stress;
  const char* name = unconfined ? "axial stress" : "q";
  const std::size_t half = smoothing_half_rows(c.rows());
  if (c.rows() < 2 * half + 1)
    throw InputError(
        fmt::format("{}: stage {} has {} rows, needed for a strength: {}", c.path, c.stage, c.rows(), 2 * half + 1));
  const std::vector<double> smooth = smoothed(raw);
  const std::size_t peak = largest_row(smooth);
  if (!(smooth[peak] > 0) || peak == 0)
    throw InputError(
        fmt::format("{}: stage {}: {} never rises above its value at the stage's beginning", c.path, c.stage, name));
  if (!(c.axial_strain[peak] > 0))
    throw InputError(
        fmt::format("{}: stage {}: its largest {} stands at an axial strain of {:.3g}; allowed: a stage of "
                    "axial compression",
                    c.path, c.stage, name, c.axial_strain[peak]));
  const auto lowest_after = static_cast<std::size_t>(
      std::min_element(smooth.begin() + static_cast<std::ptrdiff_t>(peak), smooth.end()) - smooth.begin());
  const double fall = (smooth[peak] - smooth[lowest_after]) / smooth[peak];
  const bool falls = fall >= rule.drop;
  const std::optional<DamageOnset> onset = damage_onset(c, smooth, raw, peak);

  Measurement m;
  m.metric = "strength";
  m.unit = "MPa";
  const double peak_ringing = ringing(raw, peak);
  const double peak_strain_uncertainty = strain_uncertainty_of_peak(c.axial_strain, smooth, peak, peak_ringing);
  Crossing at{peak, 0};
  std::string criterion;
  double strain = c.axial_strain[peak], strain_uncertainty = peak_strain_uncertainty;
  if (rule.criterion == StrengthCriterion::damage_onset) {
    if (!onset)
      throw InputError(
          fmt::format("{}: stage {}: damage dissipation does not grow before the peak, so it has no onset; "
                      "allowed: --criterion peak",
                      c.path, c.stage));
    criterion = "damage-onset";
    m.value = onset->stress;
    strain = onset->strain;
    strain_uncertainty = onset->strain_uncertainty;
    at = at_strain(c.axial_strain, strain, peak);
    m.method = fmt::format(
        "{} where the steepest tangent of the damage dissipation meets its level at the stage's beginning", name);
  } else if (unconfined || (falls && strain <= rule.at_strain)) {
    criterion = falls ? "peak" : "largest";
    m.value = smooth[peak];
    m.method = fmt::format("largest smoothed {}", name);
    if (!falls)
      m.notes.push_back(
          fmt::format("no peak: the axial stress falls by {:.2g} % after its largest value, less than the "
                      "{:g} % of a failure",
                      100 * fall, 100 * rule.drop));
  } else {
    // A test that was to end at this strain ends there but for rounding.
    constexpr double rounding = 1e-6;
    const double last_strain = c.axial_strain.back();
    const bool ends_there = std::abs(last_strain - rule.at_strain) <= rounding * rule.at_strain;
    const auto crossing = reach(c.axial_strain, ends_there ? std::min(last_strain, rule.at_strain) : rule.at_strain);
    if (!crossing)
      throw InputError(
          fmt::format("{}: stage {}: q has no peak (a fall of {:g} %) and the axial strain ends at {:.4g}; "
                      "allowed: a run to {:g}, or --at-strain",
                      c.path, c.stage, 100 * rule.drop, c.axial_strain.back(), rule.at_strain));
    criterion = "at-strain";
    m.value = crossing->of(smooth);
    strain = rule.at_strain;
    strain_uncertainty = 0; // given
    at = *crossing;
    m.method = fmt::format("smoothed q at an axial strain of {:g}, without a peak by then", rule.at_strain);
  }
  m.method += fmt::format("; parabolas over {} rows", 2 * half + 1);

  const bool at_onset = rule.criterion == StrengthCriterion::damage_onset;
  const auto uncertainty = [&](const std::vector<double>& column) { // a peak is flat: its strain hardly matters
    const double reach = at_onset ? strain_uncertainty : 0.0;
    return std::hypot(ringing(column, at.row), half_change(column, c.axial_strain, strain, reach));
  };
  m.uncertainty = at_onset ? onset->stress_uncertainty : ringing(raw, at.row);
  m.uncertainty_meaning = "twice the scatter of the window's rows about parabolas over twice as many rows";
  if (at_onset) m.uncertainty_meaning += ", and what the tangent's noise and length move the onset by, as hypotenuse";
  const RowRange rows = ringing_rows(at.row, c.rows());
  m.window.stage = c.stage;
  m.window.stage_type = c.type;
  m.window.first_row = c.first_row + rows.first;
  m.window.last_row = c.first_row + rows.last;
  m.window.strain = range_of(c.axial_strain, rows.first, rows.last);
  m.window.stress_name = unconfined ? "axial_stress" : "deviatoric_stress";
  m.window.stress = range_of(raw, rows.first, rows.last);
  m.details = {{"test", unconfined ? "unconfined" : "triaxial"},
               {"criterion", criterion},
               {"axial_strain_at_strength", strain},
               {"axial_strain_at_strength_uncertainty", strain_uncertainty},
               {"mean_stress_at_strength_MPa", at.of(c.mean_stress)},
               {"mean_stress_at_strength_uncertainty_MPa", uncertainty(c.mean_stress)},
               {"lateral_stress_at_strength_MPa", at.of(c.lateral_stress)},
               {"lateral_stress_at_strength_uncertainty_MPa", uncertainty(c.lateral_stress)},
               {"peak_MPa", smooth[peak]},
               {"peak_uncertainty_MPa", peak_ringing},
               {"axial_strain_at_peak", c.axial_strain[peak]},
               {"axial_strain_at_peak_uncertainty", peak_strain_uncertainty},
               {"fall_after_peak", fall},
               {"fall_after_peak_uncertainty", std::hypot(peak_ringing, ringing(raw, lowest_after)) / smooth[peak]},
               {"damage_onset_stress_MPa", nullptr},
               {"damage_onset_stress_uncertainty_MPa", nullptr},
               {"damage_onset_strain", nullptr},
               {"damage_onset_strain_uncertainty", nullptr},
               {"relative_density_at_start", c.relative_density.front()}};
  m.brief =
      fmt::format("{}, {} at an axial strain of {:.4f}", unconfined ? "unconfined" : "triaxial", criterion, strain);
  if (onset) {
    m.details["damage_onset_stress_MPa"] = onset->stress;
    m.details["damage_onset_stress_uncertainty_MPa"] = onset->stress_uncertainty;
    m.details["damage_onset_strain"] = onset->strain;
    m.details["damage_onset_strain_uncertainty"] = onset->strain_uncertainty;
  }
  return m;
}

Measurement measure_strength(const schema::FileReader& file, std::optional<int> number, const StrengthRule& rule) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const StageRows& stage =
      choose_stage(stages, number, {"unconfined_compression", "triaxial_compression"}, file.path());
  return strength(stage_curve(history, stage, file.path()), rule);
}

} // namespace mpfem
