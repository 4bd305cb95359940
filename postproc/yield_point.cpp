#include "postproc/yield_point.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/smoothing.hpp"
#include "postproc/statistics.hpp"

namespace mpfem {

namespace {

/// Half width of the 95 % interval of one row's value, from how rows scatter about the smoothed curve; 0 for curves too
/// short to be smoothed.
double ringing(const std::vector<double>& values) {
  if (values.size() < 2 * smoothing_half_rows(values.size()) + 1) return 0;
  const std::vector<double> smooth = smoothed(values);
  double squares = 0;
  for (std::size_t row = 0; row < values.size(); ++row)
    squares += (values[row] - smooth[row]) * (values[row] - smooth[row]);
  return 1.96 * std::sqrt(squares / static_cast<double>(values.size()));
}

} // namespace

Measurement yield_point(const StageCurve& c, double ratio) {
  std::vector<double> dissipated(c.rows());
  for (std::size_t row = 0; row < c.rows(); ++row)
    dissipated[row] = c.plastic_dissipation[row] + c.damage_dissipation[row];
  if (!(dissipated.front() > 0))
    throw InputError(fmt::format("{}: nothing was dissipated before stage {}, so {:g} times as much is no criterion; "
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
  const Crossing at{next - 1, (threshold - dissipated[next - 1]) / (dissipated[next] - dissipated[next - 1])};

  const auto uncertainty = [&](const std::vector<double>& values) {
    return std::hypot(at.half_spacing(values), ringing(values));
  };

  Measurement m;
  m.metric = "yield";
  m.value = at.of(c.deviatoric_stress);
  m.unit = "MPa";
  m.uncertainty = uncertainty(c.deviatoric_stress);
  m.uncertainty_meaning =
      "half of the change between the rows on both sides, and 95 % of the stage's ringing, as hypotenuse";
  m.window.stage = c.stage;
  m.window.stage_type = c.type;
  m.window.first_row = c.first_row + at.row;
  m.window.last_row = c.first_row + next;
  m.window.strain = range_of(c.axial_strain, at.row, next);
  m.window.stress_name = "deviatoric_stress";
  m.window.stress = range_of(c.deviatoric_stress, at.row, next);
  m.method = fmt::format("first point where plastic and damage dissipation reach {:g} times their sum at the stage's "
                         "beginning, linear between rows",
                         ratio);
  m.details = {{"deviatoric_stress_MPa", m.value},
               {"deviatoric_stress_uncertainty_MPa", m.uncertainty},
               {"mean_stress_MPa", at.of(c.mean_stress)},
               {"mean_stress_uncertainty_MPa", uncertainty(c.mean_stress)},
               {"axial_strain_at_yield", at.of(c.axial_strain)},
               {"axial_strain_at_yield_uncertainty", at.half_spacing(c.axial_strain)},
               {"volumetric_strain_at_yield", at.of(c.volumetric_strain)},
               {"volumetric_strain_at_yield_uncertainty", at.half_spacing(c.volumetric_strain)},
               {"mean_stress_at_start_MPa", c.mean_stress.front()},
               {"deviatoric_stress_at_start_MPa", c.deviatoric_stress.front()},
               {"distance_from_start_MPa", std::hypot(at.of(c.mean_stress) - c.mean_stress.front(),
                                                      at.of(c.deviatoric_stress) - c.deviatoric_stress.front())},
               {"dissipation_at_start_mJ", dissipated.front()},
               {"damage_share_of_dissipation_since_start",
                (at.of(c.damage_dissipation) - c.damage_dissipation.front()) / (threshold - dissipated.front())}};
  m.brief = fmt::format("q at p = {:.5g} ± {:.2g} MPa", at.of(c.mean_stress), uncertainty(c.mean_stress));
  if (next == 1) m.notes.emplace_back("yields before the stage's first row: record more rows");
  return m;
}

Measurement measure_yield(const schema::FileReader& file, std::optional<int> number, double ratio) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  return yield_point(stage_curve(history, choose_stage(stages, number, {"probe"}, file.path()), file.path()), ratio);
}

} // namespace mpfem
