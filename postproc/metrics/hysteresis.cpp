#include "postproc/metrics/hysteresis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/uncertainty.hpp"
#include "postproc/run_data/windows.hpp"

namespace mpfem {

namespace {

struct TurningPoint {
  std::size_t row;
  bool high;
};

std::vector<TurningPoint> turning_points(std::span<const double> p) {
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  const double threshold = 0.2 * (*high - *low);
  std::vector<TurningPoint> points;
  if (!(threshold > 0)) return points;
  std::size_t lowest = 0, highest = 0;
  for (std::size_t row = 0; row < p.size(); ++row) {
    if (p[row] < p[lowest]) lowest = row;
    if (p[row] > p[highest]) highest = row;
    const bool may_be_low = points.empty() || points.back().high, may_be_high = points.empty() || !points.back().high;
    if (may_be_low && p[row] > p[lowest] + threshold) {
      points.push_back({lowest, false});
      highest = row;
    } else if (may_be_high && p[row] < p[highest] - threshold) {
      points.push_back({highest, true});
      lowest = row;
    }
  }
  // The extreme after the last turning point counts as one too: the curve ends before it can turn back.
  if (!points.empty()) points.push_back(points.back().high ? TurningPoint{lowest, false} : TurningPoint{highest, true});
  return points;
}

double area_with_stride(std::span<const double> p, std::span<const double> strain, CycleRows c, std::size_t stride) {
  const double base = 0.5 * (p[c.begin] + p[c.end]);
  double area = 0;
  std::size_t row = c.begin;
  while (row < c.end) {
    // The turning points are kept, so that only the resolution of the loop changes and its tips remain.
    const std::size_t stop = row < c.top ? c.top : c.end, next = std::min(row + stride, stop);
    area += (0.5 * (p[row] + p[next]) - base) * (strain[next] - strain[row]);
    row = next;
  }
  return area;
}

/// Energy dissipated from the first row of a cycle to its last (mJ), and its uncertainty from the places of these
/// turning points.
double dissipated_in(std::span<const double> dissipation, CycleRows c) {
  return dissipation[c.end] - dissipation[c.begin];
}
double turning_uncertainty(std::span<const double> dissipation, CycleRows c) {
  return turning_point_uncertainty(dissipation, c.begin) + turning_point_uncertainty(dissipation, c.end);
}

/// Curves row by row, as for hysteresis().
struct Curves {
  std::span<const double> mean_stress, volumetric_strain, relative_density, plastic_dissipation, damage_dissipation,
      energy_residual;
};

/// `low`, `high`: the stresses that all cycles reach, MPa.
CycleResult cycle_result(const Curves& curve, CycleRows c, double low, double high) {
  const auto& p = curve.mean_stress;
  const Crossing at_high = first_crossing(p, c.begin, c.top, high).value_or(Crossing{c.top, 0}),
                 at_low = first_crossing(p, c.top, c.end, low).value_or(Crossing{c.end, 0});
  CycleResult r;
  r.rows = c;
  r.lowest_stress = std::min(p[c.begin], p[c.end]);
  r.highest_stress = p[c.top];
  r.area = loop_area(p, curve.volumetric_strain, c);
  r.area_uncertainty = std::abs(area_with_stride(p, curve.volumetric_strain, c, 2) - r.area);
  r.density_at_high = at_high.of(curve.relative_density);
  r.density_at_low = at_low.of(curve.relative_density);
  r.density_at_high_uncertainty = interpolation_uncertainty(p, curve.relative_density, at_high, high, {c.begin, c.top});
  r.density_at_low_uncertainty = interpolation_uncertainty(p, curve.relative_density, at_low, low, {c.top, c.end});
  r.plastic = dissipated_in(curve.plastic_dissipation, c);
  r.damage = dissipated_in(curve.damage_dissipation, c);
  r.plastic_uncertainty =
      std::hypot(turning_uncertainty(curve.plastic_dissipation, c), dissipated_in(curve.energy_residual, c));
  r.damage_uncertainty = turning_uncertainty(curve.damage_dissipation, c); // of bonds: see energy_uncertainty
  return r;
}

const CycleResult& first_whole(const Hysteresis& h) {
  return h.cycles[h.cycles.front().rows.whole ? 0 : 1];
}
std::size_t whole_cycles(const Hysteresis& h) {
  return h.cycles.size() - (h.cycles.front().rows.whole ? 0 : 1);
}

} // namespace

std::vector<CycleRows> find_cycles(std::span<const double> p) {
  const auto points = turning_points(p);
  std::vector<CycleRows> cycles;
  for (std::size_t i = 0; i + 2 < points.size(); ++i) {
    if (points[i].high) continue;
    // The last lowest point counts only if the stress has come down to where the cycle began, to within a fifth of the
    // rise.
    const double rise = p[points[i + 1].row] - p[points[i].row], fall = p[points[i + 1].row] - p[points[i + 2].row];
    const bool whole = !cycles.empty() || rise > 0.8 * fall;
    if (fall > 0.8 * rise) cycles.push_back({points[i].row, points[i + 1].row, points[i + 2].row, whole});
  }
  return cycles;
}

double loop_area(std::span<const double> mean_stress, std::span<const double> volumetric_strain, CycleRows cycle) {
  return area_with_stride(mean_stress, volumetric_strain, cycle, 1);
}

Hysteresis hysteresis(std::span<const double> mean_stress, std::span<const double> volumetric_strain,
                      std::span<const double> relative_density, std::span<const double> plastic_dissipation,
                      std::span<const double> damage_dissipation, std::span<const double> energy_residual,
                      const std::string& path) {
  Hysteresis h;
  const auto cycles = find_cycles(mean_stress);
  if (cycles.empty() || !cycles.back().whole)
    throw InputError(
        fmt::format("{}: the mean stress makes no whole cycle, from low over high to low, allowed: a stage "
                    "with one, or --stage N",
                    one_line(path)));
  h.low_stress = mean_stress[cycles.front().end];
  h.high_stress = mean_stress[cycles.front().top];
  for (const CycleRows& c : cycles) {
    h.low_stress = std::max(h.low_stress, mean_stress[c.end]);
    h.high_stress = std::min(h.high_stress, mean_stress[c.top]);
  }
  const Curves curves{mean_stress,         volumetric_strain,  relative_density,
                      plastic_dissipation, damage_dissipation, energy_residual};
  for (const CycleRows& c : cycles) h.cycles.push_back(cycle_result(curves, c, h.low_stress, h.high_stress));
  const auto steps = static_cast<double>(whole_cycles(h)) - 1;
  if (steps > 0) {
    const CycleResult &first = first_whole(h), &last = h.cycles.back();
    h.drift_at_low = {(last.density_at_low - first.density_at_low) / steps,
                      std::hypot(first.density_at_low_uncertainty, last.density_at_low_uncertainty) / steps};
    h.drift_at_high = {(last.density_at_high - first.density_at_high) / steps,
                       std::hypot(first.density_at_high_uncertainty, last.density_at_high_uncertainty) / steps};
  }
  return h;
}

namespace {

/// A cycle in its table.
struct CycleOfTable {
  const CycleResult& result;
  const CycleResult& before; ///< of the first cycle: itself, so no change
  std::size_t place = 0;     ///< in the list of cycles
  std::size_t number = 0;    ///< of whole cycles, from 1; 0: a first loading that is not whole
  std::size_t first_row = 0; ///< of the stage, in the history
};

struct CycleColumn {
  const char *name, *unit;
  double (*value)(const CycleOfTable&);
};

double number(std::size_t value) {
  return static_cast<double>(value);
}

constexpr CycleColumn cycle_columns[] = {
    {"cycle", "1", [](const CycleOfTable& c) { return number(c.number); }},
    {"first_row", "1", [](const CycleOfTable& c) { return number(c.first_row + c.result.rows.begin); }},
    {"top_row", "1", [](const CycleOfTable& c) { return number(c.first_row + c.result.rows.top); }},
    {"last_row", "1", [](const CycleOfTable& c) { return number(c.first_row + c.result.rows.end); }},
    {"lowest_mean_stress", "MPa", [](const CycleOfTable& c) { return c.result.lowest_stress; }},
    {"highest_mean_stress", "MPa", [](const CycleOfTable& c) { return c.result.highest_stress; }},
    {"loop_area", "MPa", [](const CycleOfTable& c) { return c.result.area; }},
    {"loop_area_uncertainty", "MPa", [](const CycleOfTable& c) { return c.result.area_uncertainty; }},
    {"relative_density_at_low_stress", "1", [](const CycleOfTable& c) { return c.result.density_at_low; }},
    {"relative_density_at_high_stress", "1", [](const CycleOfTable& c) { return c.result.density_at_high; }},
    {"plastic_dissipation", "mJ", [](const CycleOfTable& c) { return c.result.plastic; }},
    {"damage_dissipation", "mJ", [](const CycleOfTable& c) { return c.result.damage; }},
    {"relative_density_at_low_stress_uncertainty", "1",
     [](const CycleOfTable& c) { return c.result.density_at_low_uncertainty; }},
    {"relative_density_at_high_stress_uncertainty", "1",
     [](const CycleOfTable& c) { return c.result.density_at_high_uncertainty; }},
    {"plastic_dissipation_uncertainty", "mJ", [](const CycleOfTable& c) { return c.result.plastic_uncertainty; }},
    {"damage_dissipation_uncertainty", "mJ", [](const CycleOfTable& c) { return c.result.damage_uncertainty; }},
    {"cycles_before", "1", [](const CycleOfTable& c) { return number(c.place); }},
    {"change_of_density_at_low_stress", "1",
     [](const CycleOfTable& c) { return c.result.density_at_low - c.before.density_at_low; }},
    {"change_of_density_at_high_stress", "1",
     [](const CycleOfTable& c) { return c.result.density_at_high - c.before.density_at_high; }},
};

} // namespace

std::vector<Column> cycle_table(const Hysteresis& h, std::size_t first_row) {
  const std::size_t number_of_first = h.cycles.front().rows.whole ? 1 : 0;
  std::vector<Column> columns;
  for (const CycleColumn& column : cycle_columns) {
    columns.push_back({column.name, column.unit, {}});
    for (std::size_t i = 0; i < h.cycles.size(); ++i)
      columns.back().values.push_back(
          column.value({h.cycles[i], h.cycles[i > 0 ? i - 1 : 0], i, number_of_first + i, first_row}));
  }
  return columns;
}

namespace {

/// The given stage, otherwise the last stress_cycles, otherwise the whole run as stage -1.
StageRows choose_cycles(const HistoryTable& history, const schema::FileReader& file, std::optional<int> number) {
  const auto stages = stages_of(history, scenario_facts(file));
  const StageRows& stage = choose_stage(stages, number, {"stress_cycles"}, file.path());
  if (!number && stage.type != "stress_cycles") return {-1, "", 0, history.rows() - 1, ""};
  return stage;
}

nlohmann::ordered_json details_of(const Hysteresis& h, const std::vector<Column>& cycles) {
  const auto value = [](const std::optional<Drift>& drift) {
    return number_or_null(drift ? std::optional(drift->value) : std::nullopt);
  };
  const auto uncertainty = [](const std::optional<Drift>& drift) {
    return number_or_null(drift ? std::optional(drift->uncertainty) : std::nullopt);
  };
  const bool high_is_larger = h.drift_at_low && h.drift_at_low->uncertainty < h.drift_at_high->uncertainty;
  nlohmann::ordered_json json = {
      {"cycles", whole_cycles(h)},
      {"drift_of_relative_density_at_low_stress_per_cycle", value(h.drift_at_low)},
      {"drift_of_relative_density_at_low_stress_per_cycle_uncertainty", uncertainty(h.drift_at_low)},
      {"drift_of_relative_density_at_high_stress_per_cycle", value(h.drift_at_high)},
      {"drift_of_relative_density_at_high_stress_per_cycle_uncertainty", uncertainty(h.drift_at_high)},
      {"drift_uncertainty", uncertainty(high_is_larger ? h.drift_at_high : h.drift_at_low)},
      {"low_stress_MPa", h.low_stress},
      {"high_stress_MPa", h.high_stress}};
  for (const Column& column : cycles) json["per_cycle"][name_with_unit(column.name, column.unit)] = column.values;
  return json;
}

std::string drift_text(const Hysteresis& h) {
  if (!h.drift_at_low) return "no drift from one cycle";
  return fmt::format("drift of the relative density per cycle {:+.2e} at {:.3g} MPa and {:+.2e} at {:.3g} MPa",
                     h.drift_at_low->value, h.low_stress, h.drift_at_high->value, h.high_stress);
}

/// `highest_stress`: of the window, MPa.
std::vector<std::string> notes_on(const Hysteresis& h, std::array<double, 2> deviatoric, double highest_stress,
                                  double first_stress) {
  std::vector<std::string> notes;
  if (std::max(-deviatoric[0], deviatoric[1]) > 0.1 * highest_stress)
    notes.push_back(fmt::format("the cycles are not isotropic: q is between {:.3g} and {:.3g} MPa in them",
                                deviatoric[0], deviatoric[1]));
  if (!h.cycles.front().rows.whole)
    notes.push_back(fmt::format("the first loading begins at {:.3g} MPa, between the cycles' stresses: it does not "
                                "count as a cycle and has number 0",
                                first_stress));
  if (whole_cycles(h) == 1) notes.emplace_back("one whole cycle: no drift from cycle to cycle");
  return notes;
}

} // namespace

HysteresisMeasurement measure_hysteresis(const schema::FileReader& file, std::optional<int> number) {
  const HistoryTable history(file);
  const StageRows stage = choose_cycles(history, file, number);
  const auto part = [&](const char* name) { return stage.rows().of(history[name]); };
  const Hysteresis h =
      hysteresis(part("mean_stress"), part("volumetric_strain"), part("relative_density"), part("plastic_dissipation"),
                 part("damage_dissipation"), part("energy_residual"), file.path());
  const CycleResult& last = h.cycles.back();
  HysteresisMeasurement result;
  result.cycles = cycle_table(h, stage.first);
  Measurement& m = result.measurement;
  m.metric = "hysteresis";
  m.value = last.area;
  m.unit = "MPa";
  m.uncertainty = last.area_uncertainty;
  m.uncertainty_meaning = "change of the area when every second row is left out";
  m.window = isotropic_window(history, stage, {stage.first + first_whole(h).rows.begin, stage.first + last.rows.end});
  m.method =
      "area of the last cycle's loop, integral of (p - p_low) over the volumetric strain (mJ/mm^3 = MPa); cycles "
      "from lowest over highest to lowest mean stress";
  m.details = details_of(h, result.cycles);
  m.brief = fmt::format("loop area of the last of {} cycles, {}, last cycle {:.3g} mJ plastic and {:.3g} mJ damage",
                        whole_cycles(h), drift_text(h), last.plastic, last.damage);
  m.notes = notes_on(h, range_of(history["deviatoric_stress"], m.window.first_row, m.window.last_row),
                     m.window.stress[1], part("mean_stress")[h.cycles.front().rows.begin]);
  return result;
}

} // namespace mpfem
