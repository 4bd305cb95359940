#include "postproc/metrics/strength.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/metrics/damage_onset.hpp"
#include "postproc/metrics/true_stress.hpp"
#include "postproc/run_data/ringing.hpp"
#include "postproc/run_data/smoothing.hpp"
#include "postproc/run_data/windows.hpp"

namespace mpfem {

namespace {

StrengthTest test_of(const StageCurve& c) {
  if (c.type == "unconfined_compression") return StrengthTest::unconfined;
  if (c.type == "triaxial_compression") return StrengthTest::triaxial;
  return c.unconfined ? StrengthTest::unconfined : StrengthTest::triaxial;
}

/// A test and the stress from which its strength is read: the axial stress, or q.
struct Test {
  const StageCurve& curve;
  bool unconfined;
  const char* stress_name;        ///< for messages
  const std::vector<double>& raw; ///< MPa, one value per row
  std::vector<double> smooth;     ///< MPa
};

Test test_on(const StageCurve& c, bool unconfined) {
  const std::size_t needed = 2 * smoothing_half_rows(c.rows()) + 1;
  if (c.rows() < needed)
    throw InputError(
        fmt::format("{}: stage {} has {} rows, needed for a strength: {}", c.path, c.stage, c.rows(), needed));
  const std::vector<double>& raw = unconfined ? c.axial_stress : c.deviatoric_stress;
  return {c, unconfined, unconfined ? "axial stress" : "q", raw, smoothed(raw)};
}

std::size_t largest_row(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// Row of the largest smoothed stress. Throws InputError where the stage is not an axial compression.
std::size_t peak_row(const Test& test) {
  const StageCurve& c = test.curve;
  const std::size_t peak = largest_row(test.smooth);
  if (!(test.smooth[peak] > 0) || peak == 0)
    throw InputError(fmt::format(
        "{}: stage {}: {} never rises above its value at the beginning of the stage, allowed: a stage that loads",
        c.path, c.stage, test.stress_name));
  if (!(c.axial_strain[peak] > 0))
    throw InputError(fmt::format("{}: stage {}: its largest {} is at an axial strain of {:.3g}, allowed: a stage of "
                                 "axial compression",
                                 c.path, c.stage, test.stress_name, c.axial_strain[peak]));
  return peak;
}

/// Uncertainty of the peak's strain: distance to the farther end of the rows around the peak in which the smoothed
/// curve is lower by no more than ringing can change the difference of two smoothed rows; at least one row.
double strain_uncertainty_of_peak(const std::vector<double>& strain, const std::vector<double>& smooth,
                                  std::size_t peak, double ringing_of_row) {
  const double left = noise_left_by_parabolas(smoothing_half_rows(strain.size()));
  const double lowest = smooth[peak] - ringing_of_row * std::sqrt(2 * left);
  std::size_t low = peak, high = peak;
  while (low > 0 && smooth[low] >= lowest) --low;
  while (high + 1 < smooth.size() && smooth[high] >= lowest) ++high;
  return std::max(strain[peak] - strain[low], strain[high] - strain[peak]);
}

/// The largest smoothed stress and the fall after it.
struct Peak {
  std::size_t row = 0;
  double stress = 0, ringing = 0;            ///< MPa
  double strain = 0, strain_uncertainty = 0; ///< 1
  double fall = 0, fall_uncertainty = 0;     ///< as shares of the stress
};

Peak peak_at(std::size_t row, const Test& test) {
  const auto lowest_after = static_cast<std::size_t>(
      std::min_element(test.smooth.begin() + static_cast<std::ptrdiff_t>(row), test.smooth.end()) -
      test.smooth.begin());
  Peak peak;
  peak.row = row;
  peak.stress = test.smooth[row];
  peak.ringing = ringing(test.raw, row);
  peak.strain = test.curve.axial_strain[row];
  peak.strain_uncertainty = strain_uncertainty_of_peak(test.curve.axial_strain, test.smooth, row, peak.ringing);
  peak.fall = (peak.stress - test.smooth[lowest_after]) / peak.stress;
  peak.fall_uncertainty = std::hypot(peak.ringing, ringing(test.raw, lowest_after)) / peak.stress;
  return peak;
}

/// A strength by one criterion, and where it is read.
struct Reading {
  std::string criterion;
  double stress = 0, stress_uncertainty = 0; ///< MPa
  double strain = 0, strain_uncertainty = 0; ///< 1
  Crossing at;
  std::string method;
  std::vector<std::string> notes;
};

Reading at_damage_onset(const Test& test, std::size_t peak, const std::optional<DamageOnset>& onset) {
  if (!onset)
    throw InputError(fmt::format("{}: stage {}: damage dissipation does not grow before the peak, so it has no onset, "
                                 "allowed: --criterion peak",
                                 test.curve.path, test.curve.stage));
  return {"damage-onset",
          onset->stress,
          onset->stress_uncertainty,
          onset->strain,
          onset->strain_uncertainty,
          at_strain(test.curve.axial_strain, onset->strain, peak),
          fmt::format("{} where the steepest tangent of the damage dissipation meets its level at the stage's "
                      "beginning",
                      test.stress_name),
          {}};
}

/// `falls`: the curve falls after the peak by the share that marks a failure.
Reading at_peak(const Test& test, const Peak& peak, bool falls, const StrengthRule& rule) {
  Reading reading{falls ? "peak" : "largest",
                  peak.stress,
                  peak.ringing,
                  peak.strain,
                  peak.strain_uncertainty,
                  {peak.row, 0},
                  fmt::format("largest smoothed {}", test.stress_name),
                  {}};
  if (!falls)
    reading.notes.push_back(
        fmt::format("no peak: the axial stress falls by {:.3g} % after its largest value, less than the "
                    "{:g} % of a failure",
                    100 * peak.fall, 100 * rule.drop));
  return reading;
}

/// q at the strain of the rule, for a test without a peak by then.
Reading at_given_strain(const Test& test, const StrengthRule& rule) {
  const StageCurve& c = test.curve;
  // A test meant to end at this strain ends there to within rounding.
  constexpr double rounding = 1e-6;
  const double last_strain = c.axial_strain.back();
  const bool ends_there = std::abs(last_strain - rule.at_strain) <= rounding * rule.at_strain;
  const auto crossing = first_crossing(c.axial_strain, 0, c.rows() - 1,
                                       ends_there ? std::min(last_strain, rule.at_strain) : rule.at_strain);
  if (!crossing)
    throw InputError(fmt::format("{}: stage {}: q has no peak (a fall of {:g} %) and the axial strain ends at {:.4g}, "
                                 "allowed: a run to {:g}, or --at-strain",
                                 c.path, c.stage, 100 * rule.drop, c.axial_strain.back(), rule.at_strain));
  return {"at-strain",
          crossing->of(test.smooth),
          ringing(test.raw, crossing->row),
          rule.at_strain,
          0, // given
          *crossing,
          fmt::format("smoothed q at an axial strain of {:g}, without a peak by then", rule.at_strain),
          {}};
}

Reading reading_by(const StrengthRule& rule, const Test& test, const Peak& peak,
                   const std::optional<DamageOnset>& onset) {
  if (rule.criterion == StrengthCriterion::damage_onset) return at_damage_onset(test, peak.row, onset);
  const bool falls = peak.fall >= rule.drop;
  if (test.unconfined || (falls && peak.strain <= rule.at_strain)) return at_peak(test, peak, falls, rule);
  return at_given_strain(test, rule);
}

/// Mean and lateral stress where the strength is read. `strain_reach` is the uncertainty of that strain; it is 0 at a
/// peak, which is flat, so that the strain hardly matters.
nlohmann::ordered_json stresses_at(const Reading& reading, const StageCurve& c, double strain_reach) {
  const auto uncertainty = [&](const std::vector<double>& column) {
    return std::hypot(ringing(column, reading.at.row),
                      half_change(column, c.axial_strain, reading.strain, strain_reach));
  };
  return {{"mean_stress_at_strength_MPa", reading.at.of(c.mean_stress)},
          {"mean_stress_at_strength_uncertainty_MPa", uncertainty(c.mean_stress)},
          {"lateral_stress_at_strength_MPa", reading.at.of(c.lateral_stress)},
          {"lateral_stress_at_strength_uncertainty_MPa", uncertainty(c.lateral_stress)}};
}

nlohmann::ordered_json peak_json(const Peak& peak) {
  return {{"peak_MPa", peak.stress},
          {"peak_uncertainty_MPa", peak.ringing},
          {"axial_strain_at_peak", peak.strain},
          {"axial_strain_at_peak_uncertainty", peak.strain_uncertainty},
          {"fall_after_peak", peak.fall},
          {"fall_after_peak_uncertainty", peak.fall_uncertainty}};
}

nlohmann::ordered_json onset_json(const std::optional<DamageOnset>& onset) {
  nlohmann::ordered_json json = {{"damage_onset_stress_MPa", nullptr},
                                 {"damage_onset_stress_uncertainty_MPa", nullptr},
                                 {"damage_onset_strain", nullptr},
                                 {"damage_onset_strain_uncertainty", nullptr}};
  if (!onset) return json;
  json["damage_onset_stress_MPa"] = onset->stress;
  json["damage_onset_stress_uncertainty_MPa"] = onset->stress_uncertainty;
  json["damage_onset_strain"] = onset->strain;
  json["damage_onset_strain_uncertainty"] = onset->strain_uncertainty;
  return json;
}

} // namespace

Measurement strength(const StageCurve& c, const StrengthRule& rule) {
  const Test test = test_on(c, rule.test.value_or(test_of(c)) == StrengthTest::unconfined);
  const Peak peak = peak_at(peak_row(test), test);
  const std::optional<DamageOnset> onset = damage_onset(c, test.smooth, test.raw, peak.row);
  const Reading reading = reading_by(rule, test, peak, onset);
  const bool at_onset = rule.criterion == StrengthCriterion::damage_onset;
  const char* test_name = test.unconfined ? "unconfined" : "triaxial";

  Measurement m;
  m.metric = "strength";
  m.value = reading.stress;
  m.unit = "MPa";
  m.uncertainty = reading.stress_uncertainty;
  m.uncertainty_meaning = "twice the scatter of the window's rows about parabolas over twice as many rows";
  if (at_onset)
    m.uncertainty_meaning += ", and the shift of the onset by noise and length of the tangent, added in quadrature";
  m.method = fmt::format("{}; parabolas over {} rows", reading.method, 2 * smoothing_half_rows(c.rows()) + 1);
  m.window = axial_window(c, ringing_rows(reading.at.row, c.rows()),
                          test.unconfined ? "axial_stress" : "deviatoric_stress", test.raw);
  m.details = {{"test", test_name},
               {"criterion", reading.criterion},
               {"axial_strain_at_strength", reading.strain},
               {"axial_strain_at_strength_uncertainty", reading.strain_uncertainty}};
  m.details.update(stresses_at(reading, c, at_onset ? reading.strain_uncertainty : 0.0));
  m.details.update(peak_json(peak));
  m.details.update(onset_json(onset));
  m.details["relative_density_at_start"] = c.relative_density.front();
  m.brief = fmt::format("{}, {} at an axial strain of {:.4f}", test_name, reading.criterion, reading.strain);
  m.notes = reading.notes;
  return m;
}

Measurement measure_strength(const schema::FileReader& file, std::optional<int> number, const StrengthRule& rule) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const std::vector<std::string> tests = {"unconfined_compression", "triaxial_compression"};
  const StageRows& stage = choose_stage(stages, number, tests, file.path());
  Measurement m = strength(stage_curve(history, stage, file.path()), rule);
  add_true_stress(m, history, stage);
  if (const std::string note = note_of_other_stage(stage, tests); !note.empty()) m.notes.push_back(note);
  return m;
}

} // namespace mpfem
