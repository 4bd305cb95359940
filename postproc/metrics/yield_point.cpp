#include "postproc/metrics/yield_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/smoothing.hpp"
#include "postproc/run_data/windows.hpp"

namespace mpfem {

namespace {

/// Half width of the 95 % interval of one row's value, from the scatter of the rows about the smoothed curve; NaN for
/// curves too short to be smoothed.
double ringing(const std::vector<double>& values) {
  if (values.size() < 2 * smoothing_half_rows(values.size()) + 1) return std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> smooth = smoothed(values);
  double squares = 0;
  for (std::size_t row = 0; row < values.size(); ++row)
    squares += (values[row] - smooth[row]) * (values[row] - smooth[row]);
  return 1.96 * std::sqrt(squares / static_cast<double>(values.size()));
}

/// The first point at which a stage yields.
struct YieldPoint {
  Crossing at;
  double threshold = 0;           ///< mJ, dissipated at yield
  double dissipated_at_start = 0; ///< mJ
};

/// Throws InputError where nothing was dissipated before the stage, or it does not yield.
YieldPoint find_yield(const StageCurve& c, double ratio) {
  std::vector<double> dissipated(c.rows());
  for (std::size_t row = 0; row < c.rows(); ++row)
    dissipated[row] = c.plastic_dissipation[row] + c.damage_dissipation[row];
  if (!(dissipated.front() > 0))
    throw InputError(
        fmt::format("{}: nothing was dissipated before stage {}, so {:g} times that dissipation is not a criterion, "
                    "allowed: a probe after a compaction",
                    c.path, c.stage, ratio));
  const double threshold = ratio * dissipated.front();
  std::size_t next = 1;
  while (next < c.rows() && dissipated[next] < threshold) ++next;
  if (next >= c.rows())
    throw InputError(fmt::format("{}: stage {} does not yield: its dissipation rises to {:.6f} times the value at its "
                                 "beginning, needed: {:g}",
                                 c.path, c.stage,
                                 *std::max_element(dissipated.begin(), dissipated.end()) / dissipated.front(), ratio));
  return {{next - 1, (threshold - dissipated[next - 1]) / (dissipated[next] - dissipated[next - 1])},
          threshold,
          dissipated.front()};
}

double stress_uncertainty(const std::vector<double>& stress, const Crossing& at) {
  return std::hypot(at.half_spacing(stress), ringing(stress));
}

nlohmann::ordered_json details_of(const YieldPoint& yield, const StageCurve& c) {
  const Crossing& at = yield.at;
  return {{"deviatoric_stress_MPa", at.of(c.deviatoric_stress)},
          {"deviatoric_stress_uncertainty_MPa", stress_uncertainty(c.deviatoric_stress, at)},
          {"mean_stress_MPa", at.of(c.mean_stress)},
          {"mean_stress_uncertainty_MPa", stress_uncertainty(c.mean_stress, at)},
          {"axial_strain_at_yield", at.of(c.axial_strain)},
          {"axial_strain_at_yield_uncertainty", at.half_spacing(c.axial_strain)},
          {"volumetric_strain_at_yield", at.of(c.volumetric_strain)},
          {"volumetric_strain_at_yield_uncertainty", at.half_spacing(c.volumetric_strain)},
          {"mean_stress_at_start_MPa", c.mean_stress.front()},
          {"deviatoric_stress_at_start_MPa", c.deviatoric_stress.front()},
          {"distance_from_start_MPa", std::hypot(at.of(c.mean_stress) - c.mean_stress.front(),
                                                 at.of(c.deviatoric_stress) - c.deviatoric_stress.front())},
          {"dissipation_at_start_mJ", yield.dissipated_at_start},
          {"damage_share_of_dissipation_since_start", (at.of(c.damage_dissipation) - c.damage_dissipation.front()) /
                                                          (yield.threshold - yield.dissipated_at_start)}};
}

} // namespace

Measurement yield_point(const StageCurve& c, double ratio) {
  const YieldPoint yield = find_yield(c, ratio);
  const std::size_t row = yield.at.row;
  Measurement m;
  m.metric = "yield";
  m.value = yield.at.of(c.deviatoric_stress);
  m.unit = "MPa";
  m.uncertainty = stress_uncertainty(c.deviatoric_stress, yield.at);
  m.uncertainty_meaning =
      "half of the change between the rows on both sides, and 95 % of the stage's ringing, added in quadrature";
  m.window = axial_window(c, {row, row + 1}, "deviatoric_stress", c.deviatoric_stress);
  m.method = fmt::format("first point where plastic and damage dissipation reach {:g} times their sum at the stage's "
                         "beginning, linear between rows",
                         ratio);
  m.details = details_of(yield, c);
  m.brief = fmt::format("q at p = {:.5g}{} MPa", yield.at.of(c.mean_stress),
                        plus_minus(stress_uncertainty(c.mean_stress, yield.at)));
  if (row == 0) m.notes.emplace_back("yields before the stage's first row: record more rows");
  return m;
}

Measurement measure_yield(const schema::FileReader& file, std::optional<int> number, double ratio) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const StageRows& stage = choose_stage(stages, number, {"probe"}, file.path());
  Measurement m = yield_point(stage_curve(history, stage, file.path()), ratio);
  const std::string note = note_of_other_stage(stage, {"probe", "unconfined_compression", "triaxial_compression"});
  if (!note.empty()) m.notes.push_back(note);
  return m;
}

} // namespace mpfem
