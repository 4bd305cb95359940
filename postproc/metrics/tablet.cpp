#include "postproc/metrics/tablet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/metrics/janssen.hpp"
#include "postproc/metrics/round_die.hpp"
#include "postproc/metrics/tablet_shape.hpp"
#include "postproc/run_data/ringing.hpp"
#include "postproc/run_data/smoothing.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/stages.hpp"
#include "postproc/run_data/uncertainty.hpp"

namespace mpfem {

namespace {

constexpr std::size_t fewest_smoothed_rows = 7;
constexpr double force_gone = 0.01;          ///< share of the peak force below which a punch has left
constexpr double largest_lower_share = 0.02; ///< of the way of both punches, in single-ended pressing

/// A value in one row, with half of its 95 % interval; NaN where that is not known.
struct Reading {
  std::size_t row = 0; ///< of the history
  double value = 0, uncertainty = 0;
};

/// The run and what has been read from it.
struct Tablet {
  const schema::FileReader& file;
  const HistoryTable& history;
  TabletRule rule;
  std::vector<double> upper{}, lower{};          ///< N, axial force of the punches, compression positive
  std::vector<double> die_normal{}, die_axial{}; ///< N, normal force and friction of the die
  StageRows press{};
  std::optional<StageRows> hold{}, unload{}, eject{};
  RowRange loaded{};                             ///< pressing and holding
  double diameter = 0;                           ///< mm, of the die
  Reading peak{};                                ///< of the upper punch
  double smallest_height = 0, height_in_die = 0; ///< mm; height_in_die: when the upper punch has left
  TabletMeasurement result{};

  double height(std::size_t row) const { return history["box_lengths_2"][row]; }
  void note(const std::string& text) { result.measurement.notes.push_back(text); }
  void add(const std::string& name, const std::string& unit, std::optional<double> value,
           std::optional<double> uncertainty = {}) {
    result.numbers.push_back({name, unit, value, value ? uncertainty : std::nullopt});
  }
};

/// Column of a tool. Throws InputError where the run has none of this name.
const std::vector<double>& tool_column(const Tablet& tablet, const std::string& tool, const std::string& option,
                                       const char* column) {
  const std::vector<std::string> tools = tablet.file.tools();
  const std::string name = fmt::format("tools/{}/{}", tool, column);
  if (std::find(tools.begin(), tools.end(), tool) != tools.end() && tablet.history.has(name))
    return tablet.history[name];
  std::vector<std::string> shown;
  for (const std::string& there : tools) shown.push_back(one_line(there));
  throw InputError(fmt::format("{}: {}: found no tool '{}' with {} in /history/tools, allowed: {}",
                               one_line(tablet.file.path()), option, one_line(tool), column,
                               shown.empty() ? "a run with rigid tools" : fmt::format("{}", fmt::join(shown, ", "))));
}

void read_tools(Tablet& tablet) {
  const TabletTools& tools = tablet.rule.tools;
  if (tools.upper == tools.lower)
    throw InputError(
        fmt::format("--lower: found '{}', which is the upper punch, allowed: another tool", one_line(tools.lower)));
  tablet.upper = tool_column(tablet, tools.upper, "--upper", "force_2");
  tablet.lower = tool_column(tablet, tools.lower, "--lower", "force_2");
  for (double& force : tablet.lower) force = -force; // the grains push it down
  tablet.die_axial = tool_column(tablet, tools.die, "--die", "force_2");
  tablet.die_normal = tool_column(tablet, tools.die, "--die", "normal_force");
}

void read_stages(Tablet& tablet) {
  const auto stages = stages_of(tablet.history, scenario_facts(tablet.file));
  const std::string& path = tablet.file.path();
  const TabletStages& names = tablet.rule.stages;
  tablet.press = need_stage(stages, names.press, "--press", path);
  const auto later = [&](const std::optional<std::string>& name, const char* usual, const std::string& option) {
    if (name) return std::optional(need_stage(stages, *name, option, path));
    const auto stage = stage_by_name(stages, usual);
    if (!stage && option != "--hold")
      tablet.note(fmt::format("no stage '{}' ({}): its results are null", usual, option));
    return stage;
  };
  tablet.hold = later(names.hold, "hold", "--hold");
  tablet.unload = later(names.unload, "unload", "--unload");
  tablet.eject = later(names.eject, "eject", "--eject");
  tablet.loaded = {tablet.press.first, std::max(tablet.press.last, tablet.hold ? tablet.hold->last : 0)};
}

/// A column in one row of `rows`: smoothed, with the uncertainty of peaks (ringing), if there are enough rows.
Reading reading_at(const std::vector<double>& column, RowRange rows, std::size_t row) {
  const auto part = rows.of(column);
  if (part.size() < fewest_smoothed_rows) return {row, column[row], std::numeric_limits<double>::quiet_NaN()};
  const std::vector<double> raw(part.begin(), part.end());
  return {row, smoothed(raw)[row - rows.first], ringing(raw, row - rows.first)};
}

/// The largest smoothed value of a column in these rows.
Reading peak_of(const std::vector<double>& column, RowRange rows) {
  const auto part = rows.of(column);
  std::vector<double> values(part.begin(), part.end());
  if (values.size() >= fewest_smoothed_rows) values = smoothed(values);
  const auto largest = std::max_element(values.begin(), values.end()) - values.begin();
  return reading_at(column, rows, rows.first + static_cast<std::size_t>(largest));
}

double relative(const Reading& reading) {
  return reading.uncertainty / reading.value;
}

/// Share of the way of both punches along the die, towards each other, that the lower one goes until the peak: 0 of
/// single-ended pressing, a half where both press alike or the die floats.
double share_of_lower_punch(const Tablet& tablet) {
  const TabletTools& tools = tablet.rule.tools;
  const auto way = [&](const std::string& tool, const std::string& option) {
    const std::vector<double>& place = tool_column(tablet, tool, option, "displacement_2");
    return place[tablet.peak.row] - place[tablet.press.first];
  };
  const double die = way(tools.die, "--die");
  const double upper = std::max(0.0, die - way(tools.upper, "--upper"));
  const double lower = std::max(0.0, way(tools.lower, "--lower") - die);
  return upper + lower > 0 ? lower / (upper + lower) : 0;
}

/// mu by Janssen's law, which holds where all grains slide along the die in one direction.
void add_wall_friction(Tablet& tablet, const DieSlice& slice, const Reading& radial, double force_uncertainty) {
  if (const double share = share_of_lower_punch(tablet); share > largest_lower_share) {
    tablet.note(fmt::format("the lower punch does {:.0f} % of the way along the die: grains slide in both directions, "
                            "and no wall friction follows from the punches",
                            100 * share));
    tablet.add("wall_friction_coefficient", "1", {});
    return;
  }
  const double friction = wall_friction(slice, radial.value);
  const double wall = std::numbers::pi * slice.diameter * slice.height; // mm^2
  tablet.add("wall_friction_coefficient", "1", friction,
             std::hypot(force_uncertainty / (radial.value * wall), friction * relative(radial)));
}

void add_wall_at_peak(Tablet& tablet, const Reading& lower) {
  const Reading normal = reading_at(tablet.die_normal, tablet.loaded, tablet.peak.row);
  const double height = tablet.height(tablet.peak.row), wall = std::numbers::pi * tablet.diameter * height;
  const double area = 0.25 * std::numbers::pi * tablet.diameter * tablet.diameter;
  const DieSlice slice{tablet.peak.value / area, lower.value / area, tablet.diameter, height};
  const double radial = normal.value / wall;
  tablet.add("radial_stress_at_peak", "MPa", radial, normal.uncertainty / wall);
  if (!(slice.lower_stress > 0 && radial > 0)) {
    tablet.note("the lower punch or the die carries no force at the peak: no transmission and no wall friction");
    for (const char* name : {"axial_transmission", "radial_over_axial_stress", "wall_friction_coefficient",
                             "die_friction_over_normal_force"})
      tablet.add(name, "1", {});
    return;
  }
  const double transmission = lower.value / tablet.peak.value, ratio = radial / mean_axial_stress_in_die(slice);
  const double forces = std::hypot(tablet.peak.uncertainty, lower.uncertainty);
  tablet.add("axial_transmission", "1", transmission,
             transmission * std::hypot(relative(tablet.peak), relative(lower)));
  tablet.add("radial_over_axial_stress", "1", ratio,
             ratio * std::hypot(relative(normal), forces / (tablet.peak.value + lower.value)));
  add_wall_friction(tablet, slice, {normal.row, radial, normal.uncertainty / wall}, forces);
  const Reading rubbing = reading_at(tablet.die_axial, tablet.loaded, tablet.peak.row);
  const double of_die = std::abs(rubbing.value) / normal.value;
  tablet.add("die_friction_over_normal_force", "1", of_die,
             std::hypot(rubbing.uncertainty / normal.value, of_die * relative(normal)));
}

void add_peak(Tablet& tablet) {
  tablet.peak = peak_of(tablet.upper, tablet.loaded);
  if (!(tablet.peak.value > 0))
    throw InputError(fmt::format("{}: stage '{}': found no force of grains on the upper punch that pushes it up, "
                                 "allowed: a stage that presses, --press NAME",
                                 one_line(tablet.file.path()), one_line(tablet.press.name)));
  const std::size_t row = tablet.peak.row;
  tablet.diameter = tablet.history["box_lengths_0"][row];
  const auto heights = tablet.loaded.of(tablet.history["box_lengths_2"]);
  tablet.smallest_height = tablet.height_in_die = *std::min_element(heights.begin(), heights.end());
  const double area = 0.25 * std::numbers::pi * tablet.diameter * tablet.diameter;
  const Reading lower = reading_at(tablet.lower, tablet.loaded, row);
  tablet.add("upper_punch_force", "N", tablet.peak.value, tablet.peak.uncertainty);
  tablet.add("lower_punch_force", "N", lower.value, lower.uncertainty);
  tablet.add("upper_punch_stress", "MPa", tablet.peak.value / area, tablet.peak.uncertainty / area);
  tablet.add("lower_punch_stress", "MPa", lower.value / area, lower.uncertainty / area);
  add_wall_at_peak(tablet, lower);
  const auto& density = tablet.history["relative_density"];
  tablet.add("relative_density_in_die", "1", density[row]);
  tablet.add("volume_loss", "1", 1 - density.front() / density[row]); // since the filled die of the first row
  tablet.add("height_at_peak", "mm", tablet.height(row));
  tablet.add("smallest_height", "mm", tablet.smallest_height);
  if (tablet.loaded.count() < fewest_smoothed_rows)
    tablet.note(fmt::format("pressing has {} rows, fewer than {}: forces are those of a row, their uncertainty is not "
                            "known",
                            tablet.loaded.count(), fewest_smoothed_rows));
}

/// Where the upper punch's force first falls to `force_gone` of its peak in the unloading; empty where it does not.
std::optional<Crossing> punch_leaves(const Tablet& tablet) {
  const double gone = force_gone * tablet.peak.value;
  const auto begin = tablet.upper.begin() + static_cast<std::ptrdiff_t>(tablet.unload->first),
             end = tablet.upper.begin() + static_cast<std::ptrdiff_t>(tablet.unload->last);
  const auto pressed = std::find_if(begin, end, [&](double force) { return force > gone; });
  return first_crossing(tablet.upper, static_cast<std::size_t>(pressed - tablet.upper.begin()), tablet.unload->last,
                        gone);
}

void add_unloading(Tablet& tablet) {
  const auto crossing = tablet.unload ? punch_leaves(tablet) : std::nullopt;
  std::optional<double> height, height_uncertainty, recovery, recovery_uncertainty, residual, residual_uncertainty;
  if (crossing) {
    const auto& heights = tablet.history["box_lengths_2"];
    height = tablet.height_in_die = crossing->of(heights);
    height_uncertainty = crossing->half_spacing(heights);
    recovery = *height / tablet.smallest_height - 1;
    recovery_uncertainty = *height_uncertainty / tablet.smallest_height;
    const double wall = std::numbers::pi * tablet.diameter * *height;
    residual = tablet.die_normal[tablet.unload->last] / wall;
    residual_uncertainty =
        row_uncertainty(tablet.history, tablet.die_normal, tablet.unload->last, tablet.unload->rows()) / wall;
  } else if (tablet.unload) {
    tablet.note(fmt::format("in stage '{}' the upper punch keeps more than {:g} % of its largest force: no height and "
                            "no residual stress after unloading",
                            one_line(tablet.unload->name), 100 * force_gone));
  }
  tablet.add("height_when_punch_leaves", "mm", height, height_uncertainty);
  tablet.add("axial_recovery_in_die", "1", recovery, recovery_uncertainty);
  tablet.add("residual_radial_stress", "MPa", residual, residual_uncertainty);
}

void add_ejection(Tablet& tablet) {
  std::optional<double> force, force_uncertainty, stress, stress_uncertainty;
  if (tablet.eject) {
    const RowRange rows = tablet.eject->rows();
    const Reading low = peak_of(tablet.lower, rows), up = peak_of(tablet.upper, rows);
    const bool from_below = low.value >= up.value;
    const Reading& largest = from_below ? low : up;
    const double wall = std::numbers::pi * tablet.diameter * tablet.height_in_die;
    force = largest.value, force_uncertainty = largest.uncertainty;
    stress = largest.value / wall, stress_uncertainty = largest.uncertainty / wall;
    tablet.result.measurement.details["ejected_by"] = from_below ? "lower punch" : "upper punch";
  }
  tablet.add("ejection_force", "N", force, force_uncertainty);
  tablet.add("ejection_stress", "MPa", stress, stress_uncertainty);
}

/// True if a snapshot of this time (s) was taken by `row`; the tolerance is half of the time since the row before.
bool taken_by(const Tablet& tablet, double time, std::size_t row) {
  const auto& times = tablet.history["time"];
  const double slack = row > 0 ? 0.5 * (times[row] - times[row - 1]) : 0;
  return time <= times[row] + slack;
}

/// Name of the last snapshot taken during pressing and holding; empty where there is none.
std::string pressed_snapshot(const Tablet& tablet) {
  std::string last;
  for (const std::string& name : tablet.file.snapshots()) {
    const double time = tablet.file.read_scalar(schema::run::snapshots_time, name);
    if (taken_by(tablet, time, tablet.loaded.last) && !taken_by(tablet, time, tablet.press.first)) last = name;
  }
  return last;
}

/// Volume (mm^3) of all grains before they were pressed.
double grain_volume(const Tablet& tablet) {
  const std::size_t row = tablet.peak.row;
  return tablet.history["relative_density"][row] * 0.25 * std::numbers::pi * tablet.diameter * tablet.diameter *
         tablet.height(row);
}

/// Thickness and diameter, or a note on why they are not known.
std::optional<TabletShape> shape_out_of_die(Tablet& tablet) {
  const std::string pressed_name = pressed_snapshot(tablet);
  if (!tablet.eject) return {};
  if (pressed_name.empty()) {
    tablet.note("no snapshot between the beginning of pressing and its end: thickness and diameter are not known");
    return {};
  }
  const int number = tablet.rule.snapshot;
  const std::string later_name = snapshot_name(tablet.file, number);
  const double time = tablet.file.read_scalar(schema::run::snapshots_time, later_name);
  const auto& times = tablet.history["time"];
  const std::size_t end = tablet.eject->last;
  if (!(time >= times[end] - 0.5 * (times[end] - times[end - 1]))) {
    tablet.note(fmt::format("snapshot {} is older than the end of stage '{}': thickness and diameter are not known",
                            one_line(later_name), one_line(tablet.eject->name)));
    return {};
  }
  const auto names = tablet.file.snapshots();
  const auto index = std::find(names.begin(), names.end(), pressed_name) - names.begin();
  const Snapshot pressed = read_snapshot(tablet.file, static_cast<int>(index)),
                 later = read_snapshot(tablet.file, number);
  const std::vector<std::int32_t> grain = grain_of_each(grain_node_offsets(tablet.file, pressed.nodes()));
  const auto grains = static_cast<double>(tablet.file.rows(schema::run::mesh_grain_node_offset) - 1);
  const double mean_diameter = std::cbrt(6 * grain_volume(tablet) / (std::numbers::pi * grains));
  const TabletShapeRule rule{tablet.rule.face_distance.value_or(mean_diameter / 20), mean_diameter / 2};
  std::string why;
  const auto shape = tablet_shape({pressed.node, later.node, grain, pressed.box_low, pressed.box_high}, rule, why);
  if (!shape) tablet.note("thickness and diameter are not known: " + why);
  tablet.result.measurement.details["face_distance_mm"] = rule.face_distance;
  tablet.result.measurement.details["snapshots"] = {pressed_name, later_name};
  return shape;
}

void add_out_of_die(Tablet& tablet) {
  const auto shape = shape_out_of_die(tablet);
  if (!shape) {
    for (const char* name : {"thickness", "diameter"}) tablet.add(name, "mm", {});
    for (const char* name :
         {"relative_density_out_of_die", "volume_loss_out_of_die", "axial_recovery", "radial_recovery"})
      tablet.add(name, "1", {});
    return;
  }
  const Ratio &h = shape->thickness, &d = shape->diameter;
  const double density = grain_volume(tablet) / (0.25 * std::numbers::pi * d.value * d.value * h.value);
  tablet.add("thickness", "mm", h.value, h.half_width);
  tablet.add("diameter", "mm", d.value, d.half_width);
  const double uncertainty = density * std::hypot(2 * d.half_width / d.value, h.half_width / h.value);
  tablet.add("relative_density_out_of_die", "1", density, uncertainty);
  const double filled = tablet.history["relative_density"].front();
  tablet.add("volume_loss_out_of_die", "1", 1 - filled / density, filled / (density * density) * uncertainty);
  tablet.add("axial_recovery", "1", h.value / tablet.smallest_height - 1, h.half_width / tablet.smallest_height);
  tablet.add("radial_recovery", "1", d.value / tablet.diameter - 1, d.half_width / tablet.diameter);
  if (density > 1 || h.value < tablet.smallest_height)
    tablet.note(fmt::format("out of the die the grains seem {}: they lie loose or have rearranged, and thickness, "
                            "diameter, density and recovery are not those of a tablet",
                            density > 1 ? "denser than solid" : "flatter than in it"));
  if (shape->grains_lost > 0)
    tablet.note(fmt::format("{} grains have moved by more than half a grain's diameter relative to the others; they "
                            "do not count in thickness and diameter",
                            shape->grains_lost));
  tablet.result.measurement.details["grains_at_upper_face"] = shape->upper_grains;
  tablet.result.measurement.details["grains_at_lower_face"] = shape->lower_grains;
  tablet.result.measurement.details["grains_at_band"] = shape->band_grains;
}

std::string key_of(const std::string& name, const std::string& unit) {
  return unit == "1" ? name : fmt::format("{}_{}", name, unit);
}

void fill_measurement(Tablet& tablet) {
  Measurement& m = tablet.result.measurement;
  m.metric = "tablet";
  m.value = tablet.history["relative_density"][tablet.peak.row];
  m.uncertainty = 0;
  m.uncertainty_meaning =
      "none: the relative density at the peak is exact; of the other numbers half of a 95 % interval";
  m.method = "relative density in the die where the smoothed force of the upper punch is largest";
  m.window = {
      tablet.press.number,  tablet.press.type,
      tablet.loaded.first,  tablet.loaded.last,
      "relative_density",   range_of(tablet.history["relative_density"], tablet.loaded.first, tablet.loaded.last),
      "upper_punch_stress", range_of(tablet.history["wall_stress_5"], tablet.loaded.first, tablet.loaded.last)};
  nlohmann::ordered_json further = std::move(m.details);
  m.details = nlohmann::ordered_json::object();
  m.details["die_diameter_mm"] = tablet.diameter;
  for (const TabletNumber& number : tablet.result.numbers) {
    m.details[key_of(number.name, number.unit)] = number_or_null(number.value);
    if (number.uncertainty) m.details[key_of(number.name + "_uncertainty", number.unit)] = *number.uncertainty;
  }
  if (further.is_object()) m.details.update(further);
}

} // namespace

TabletMeasurement measure_tablet(const schema::FileReader& file, const TabletRule& rule) {
  const HistoryTable history(file);
  Tablet tablet{.file = file, .history = history, .rule = rule};
  read_tools(tablet);
  read_stages(tablet);
  refuse_other_than_round_dies(tablet.file, false);
  add_peak(tablet);
  add_unloading(tablet);
  add_ejection(tablet);
  add_out_of_die(tablet);
  fill_measurement(tablet);
  return tablet.result;
}

std::string to_table(const std::vector<TabletNumber>& numbers) {
  std::string text;
  for (const TabletNumber& number : numbers) {
    std::string name = number.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    const std::string uncertainty = number.uncertainty ? plus_minus(*number.uncertainty) : "";
    text += number.value ? fmt::format("{:<34}{:.5g}{}{}\n", name, *number.value, uncertainty,
                                       number.unit == "1" ? "" : " " + number.unit)
                         : fmt::format("{:<34}not known\n", name);
  }
  return text;
}

} // namespace mpfem
