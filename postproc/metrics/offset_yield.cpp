#include "postproc/metrics/offset_yield.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/metrics/modulus.hpp"
#include "postproc/run_data/uncertainty.hpp"
#include "postproc/run_data/windows.hpp"

namespace mpfem {

namespace {

std::vector<double> since_start(std::vector<double> values) {
  const double start = values.front();
  for (double& value : values) value -= start;
  return values;
}

LoadingPath path_of_probe(const StageCurve& c) {
  const std::vector<double> p = since_start(c.mean_stress), q = since_start(c.deviatoric_stress);
  const double length = std::hypot(p.back(), q.back());
  if (!(length > 0))
    throw InputError(fmt::format(
        "{}: stage {} ends at the p and q at which it begins, allowed: a stage that changes p or q", c.path, c.stage));
  const double along_p = p.back() / length, along_q = q.back() / length;
  LoadingPath path{{}, {}, "strain along the path", "stress along the path"};
  for (std::size_t row = 0; row < c.rows(); ++row) {
    const double shear = c.axial_strain[row] - c.volumetric_strain[row] / 3;
    path.strain.push_back(along_p * c.volumetric_strain[row] + along_q * shear);
    path.stress.push_back(along_p * p[row] + along_q * q[row]);
  }
  return path;
}

/// The elastic part of a loading: stress = slope (strain - zero_strain).
struct ElasticLine {
  double slope = 0, uncertainty = 0; ///< MPa
  double zero_strain = 0;
  std::size_t first_row = 0; ///< first row of its window
};

/// Median over the window's rows of the strain at which a line of this slope through the row meets zero stress.
double zero_strain(const LoadingPath& path, double slope, std::size_t first, std::size_t last) {
  std::vector<double> zeros;
  for (std::size_t row = first; row <= last; ++row) zeros.push_back(path.strain[row] - path.stress[row] / slope);
  return median(zeros);
}

ElasticLine elastic_line(const StageCurve& c, const LoadingPath& path, const OffsetYieldRule& rule) {
  if (rule.slope) return {*rule.slope, 0, zero_strain(path, *rule.slope, 0, std::min<std::size_t>(6, c.rows() - 1)), 0};
  StageCurve along = c; // the columns that `modulus` uses, in the path's variables
  along.axial_strain = path.strain;
  along.axial_stress = path.stress;
  along.damage_dissipation.assign(c.rows(), 0.0);
  const Measurement m = modulus(along, {});
  const std::size_t first = m.window.first_row - c.first_row, last = m.window.last_row - c.first_row;
  return {m.value, m.uncertainty, zero_strain(path, m.value, first, last), first};
}

/// Where the plastic strain first reaches the offset.
std::optional<Crossing> reach_offset(const LoadingPath& path, const ElasticLine& line, double slope, double offset) {
  const auto plastic = [&](std::size_t row) { return path.strain[row] - line.zero_strain - path.stress[row] / slope; };
  for (std::size_t row = line.first_row; row + 1 < path.strain.size(); ++row)
    if (plastic(row) < offset && plastic(row + 1) >= offset)
      return Crossing{row, (offset - plastic(row)) / (plastic(row + 1) - plastic(row))};
  return {};
}

/// Half of a 95 % interval of a column where the offset is reached.
double uncertainty_at(const Crossing& at, const LoadingPath& path, const ElasticLine& line, double offset,
                      const std::vector<double>& values) {
  const RowRange rows = rows_about(at.row, {0, values.size() - 1});
  // With the smallest possible slope the loading may end before it yields, with the largest it may begin after.
  double by_slope = 0;
  for (const double sign : {-1.0, 1.0}) {
    const double slope = line.slope + sign * line.uncertainty;
    const auto other = slope > 0 ? reach_offset(path, line, slope, offset) : std::nullopt;
    const double end = sign < 0 ? values.back() : values[line.first_row];
    by_slope = std::max(by_slope, std::abs((other ? other->of(values) : end) - at.of(values)));
  }
  return std::hypot(at.half_spacing(values), by_slope, row_uncertainty(rows.of(path.strain), rows.of(values)));
}

nlohmann::ordered_json details_of(const StageCurve& c, const LoadingPath& path, const ElasticLine& line,
                                  const OffsetYieldRule& rule, const Crossing& at) {
  nlohmann::ordered_json details = {
      {"deviatoric_stress_MPa", at.of(c.deviatoric_stress)},
      {"mean_stress_MPa", at.of(c.mean_stress)},
      {"mean_stress_uncertainty_MPa", uncertainty_at(at, path, line, rule.offset, c.mean_stress)},
      {"axial_stress_MPa", at.of(c.axial_stress)},
      {"strain_along_path_at_yield", at.of(path.strain)},
      {"stress_along_path_at_yield_MPa", at.of(path.stress)},
      {"plastic_strain_offset", rule.offset},
      {"elastic_slope_MPa", line.slope},
      {"elastic_slope_uncertainty_MPa", line.uncertainty},
      {"axial_strain_at_yield", at.of(c.axial_strain)},
      {"volumetric_strain_at_yield", at.of(c.volumetric_strain)},
      {"dissipation_over_that_at_start", nullptr}};
  const double start = c.plastic_dissipation.front() + c.damage_dissipation.front();
  if (start > 0)
    details["dissipation_over_that_at_start"] = (at.of(c.plastic_dissipation) + at.of(c.damage_dissipation)) / start;
  return details;
}

} // namespace

LoadingPath loading_path(const StageCurve& c) {
  const bool axial =
      c.unconfined || (!c.type.empty() && c.type != "probe"); // a stage of unknown type is treated as a probe
  if (!axial) return path_of_probe(c);
  if (c.unconfined) return {c.axial_strain, since_start(c.axial_stress), "axial strain", "axial stress"};
  return {c.axial_strain, since_start(c.deviatoric_stress), "axial strain", "q"};
}

Measurement offset_yield(const StageCurve& c, const OffsetYieldRule& rule) {
  const LoadingPath path = loading_path(c);
  const ElasticLine line = elastic_line(c, path, rule);
  const auto at = reach_offset(path, line, line.slope, rule.offset);
  if (!at)
    throw InputError(fmt::format("{}: stage {} does not reach a plastic strain of {:g}, allowed: a longer loading, or "
                                 "--offset",
                                 c.path, c.stage, rule.offset));
  const std::vector<double>& column = c.unconfined ? c.axial_stress : c.deviatoric_stress;
  Measurement m;
  m.metric = "offset-yield";
  m.value = at->of(column);
  m.unit = "MPa";
  m.uncertainty = uncertainty_at(*at, path, line, rule.offset, column);
  m.uncertainty_meaning = "half of the change between two rows, the change with the elastic slope's uncertainty, and "
                          "95 % of the rows' scatter, added in quadrature";
  m.window = axial_window(c, {at->row, at->row + 1}, c.unconfined ? "axial_stress" : "deviatoric_stress", column);
  m.method = fmt::format("{} against {}: first point with a plastic strain of {:g}, with an elastic slope of {:.5g} "
                         "MPa{}",
                         path.stress_name, path.strain_name, rule.offset, line.slope,
                         rule.slope ? ", given" : " read by the rule of `modulus`");
  m.details = details_of(c, path, line, rule, *at);
  m.brief = fmt::format("p = {:.5g} MPa, elastic slope {:.5g} MPa", at->of(c.mean_stress), line.slope);
  return m;
}

Measurement measure_offset_yield(const schema::FileReader& file, std::optional<int> number,
                                 const OffsetYieldRule& rule) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const std::vector<std::string> tests = {"probe", "unconfined_compression", "triaxial_compression"};
  const StageRows& stage = choose_stage(stages, number, tests, file.path());
  Measurement m = offset_yield(stage_curve(history, stage, file.path()), rule);
  if (const std::string note = note_of_other_stage(stage, tests); !note.empty()) m.notes.push_back(note);
  return m;
}

} // namespace mpfem
