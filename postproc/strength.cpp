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

/// Slopes are taken over a fortieth of the strain at the peak to either side, whatever rows fall there: while walls start, rows lie
/// so close that the slope between neighbours is noise over nothing.
std::optional<DamageOnset> damage_onset(const StageCurve& c, const std::vector<double>& stress, std::size_t peak) {
  const std::vector<double> damage = smoothed(c.damage_dissipation);
  const double reach = (c.axial_strain[peak] - c.axial_strain.front()) / 40;
  std::optional<std::size_t> steepest;
  double slope = 0;
  for (std::size_t row = 0; row <= peak; ++row) {
    std::size_t low = row, high = row;
    while (low > 0 && c.axial_strain[row] - c.axial_strain[low] < reach) --low;
    while (high < peak && c.axial_strain[high] - c.axial_strain[row] < reach) ++high;
    const double strain = c.axial_strain[high] - c.axial_strain[low];
    if (strain < 2 * reach) continue; // at either end
    if (const double here = (damage[high] - damage[low]) / strain; here > slope) {
      slope = here;
      steepest = row;
    }
  }
  if (!steepest) return {};
  const double grown = damage[*steepest] - c.damage_dissipation.front();
  DamageOnset onset;
  onset.strain = std::max(0.0, c.axial_strain[*steepest] - grown / slope);
  std::size_t row = 0;
  while (row < *steepest && c.axial_strain[row + 1] <= onset.strain) ++row;
  const double spacing = row < *steepest ? c.axial_strain[row + 1] - c.axial_strain[row] : 0;
  onset.stress = Crossing{row, spacing > 0 ? (onset.strain - c.axial_strain[row]) / spacing : 0}.of(stress);
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
  const double lowest_after = *std::min_element(smooth.begin() + static_cast<std::ptrdiff_t>(peak), smooth.end());
  const double fall = (smooth[peak] - lowest_after) / smooth[peak];
  const bool falls = fall >= rule.drop;
  const std::optional<DamageOnset> onset = damage_onset(c, smooth, peak);

  Measurement m;
  m.metric = "strength";
  m.unit = "MPa";
  std::size_t row = peak;
  std::string criterion;
  double strain = c.axial_strain[peak];
  if (rule.criterion == StrengthCriterion::damage_onset) {
    if (!onset)
      throw InputError(
          fmt::format("{}: stage {}: damage dissipation does not grow before the peak, so it has no onset; "
                      "allowed: --criterion peak",
                      c.path, c.stage));
    criterion = "damage-onset";
    m.value = onset->stress;
    strain = onset->strain;
    while (row > 0 && c.axial_strain[row] > strain) --row;
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
    row = crossing->row;
    m.method = fmt::format("smoothed q at an axial strain of {:g}, without a peak by then", rule.at_strain);
  }
  m.method += fmt::format("; parabolas over {} rows", 2 * half + 1);

  // Parabolas twice as wide show ringing whose period the narrow ones follow.
  const std::size_t wide = c.rows() > 4 * half ? 2 * half : half;
  const std::vector<double> calm = local_parabolas(raw, wide);
  const std::size_t first = row > wide ? row - wide : 0, last = std::min(row + wide, c.rows() - 1);
  double squares = 0;
  for (std::size_t i = first; i <= last; ++i) squares += (raw[i] - calm[i]) * (raw[i] - calm[i]);
  // A parabola takes three of the rows' degrees of freedom.
  const double scatter = std::sqrt(squares / std::max(1.0, static_cast<double>(last - first) - 2));
  m.uncertainty = 2 * scatter;
  m.uncertainty_meaning = "twice the scatter of the window's rows about parabolas over twice as many rows";
  m.window.stage = c.stage;
  m.window.stage_type = c.type;
  m.window.first_row = c.first_row + first;
  m.window.last_row = c.first_row + last;
  m.window.strain = range_of(c.axial_strain, first, last);
  m.window.stress_name = unconfined ? "axial_stress" : "deviatoric_stress";
  m.window.stress = range_of(raw, first, last);
  m.details = {{"test", unconfined ? "unconfined" : "triaxial"},
               {"criterion", criterion},
               {"axial_strain_at_strength", strain},
               {"mean_stress_at_strength_MPa", c.mean_stress[row]},
               {"lateral_stress_at_strength_MPa", c.lateral_stress[row]},
               {"peak_MPa", smooth[peak]},
               {"axial_strain_at_peak", c.axial_strain[peak]},
               {"fall_after_peak", fall},
               {"damage_onset_stress_MPa", nullptr},
               {"damage_onset_strain", nullptr},
               {"relative_density_at_start", c.relative_density.front()}};
  m.brief =
      fmt::format("{}, {} at an axial strain of {:.4f}", unconfined ? "unconfined" : "triaxial", criterion, strain);
  if (onset) {
    m.details["damage_onset_stress_MPa"] = onset->stress;
    m.details["damage_onset_strain"] = onset->strain;
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
