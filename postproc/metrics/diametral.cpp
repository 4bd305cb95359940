#include "postproc/metrics/diametral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/metrics/disc_crack.hpp"
#include "postproc/run_data/ringing.hpp"
#include "postproc/run_data/smoothing.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

double diametral_stress(double force, double diameter, double thickness) {
  return 2 * force / (std::numbers::pi * diameter * thickness);
}

double flat_correction(double half_angle) {
  constexpr double small = 1e-4; // sin 2a / a = 2 - 4 a^2 / 3
  if (half_angle < small) return 1 - 4 * half_angle * half_angle / 3;
  return std::sin(2 * half_angle) / half_angle - 1;
}

std::vector<double> disc_force(std::span<const double> a, std::span<const double> b) {
  std::vector<double> force(a.size());
  double largest = 0;
  for (std::size_t row = 0; row < force.size(); ++row) {
    force[row] = 0.5 * std::abs(a[row] - b[row]);
    largest = std::max(largest, force[row]);
  }
  for (std::size_t row = 0; row < force.size() && std::min(std::abs(a[row]), std::abs(b[row])) < 0.1 * largest; ++row)
    force[row] = 0;
  return force;
}

FirstPeak first_peak(const std::vector<double>& values, double drop, double smallest,
                     const std::function<bool(std::size_t)>& counts) {
  const double least = std::max(smallest, 0.1 * *std::max_element(values.begin(), values.end()));
  FirstPeak peak;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (values[row] > values[peak.row]) peak.row = row;
    if (values[peak.row] >= least && values[row] <= (1 - drop) * values[peak.row] && counts(row)) {
      peak.falls = true;
      return peak;
    }
  }
  return peak;
}

namespace {

struct Extent {
  double low = 0, high = 0;
  double length() const { return high - low; }
};

Extent extent_along(std::span<const float> node, int axis) {
  Extent extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (auto i = static_cast<std::size_t>(axis); i < node.size(); i += 3) {
    extent.low = std::min(extent.low, static_cast<double>(node[i]));
    extent.high = std::max(extent.high, static_cast<double>(node[i]));
  }
  return extent;
}

/// The axis that is neither a nor b.
int third_axis(int a, int b) {
  return 3 - a - b;
}

} // namespace

double disc_thickness(std::span<const float> node, int load_axis, int disc_axis, double diameter) {
  constexpr double columns = 12, share_of_radius = 0.8;
  const auto load = static_cast<std::size_t>(load_axis), axis = static_cast<std::size_t>(disc_axis);
  const auto across = static_cast<std::size_t>(third_axis(load_axis, disc_axis));
  std::array<double, 3> middle{};
  for (std::size_t i = 0; i < node.size(); ++i)
    middle[i % 3] += 3 * static_cast<double>(node[i]) / static_cast<double>(node.size());
  std::map<std::pair<int, int>, Extent> local;
  for (std::size_t i = 0; i < node.size(); i += 3) {
    const auto column = [&](std::size_t k) {
      return static_cast<int>(std::floor((static_cast<double>(node[i + k]) - middle[k]) * columns / diameter));
    };
    const std::pair<int, int> place{column(load), column(across)};
    if (std::hypot(place.first + 0.5, place.second + 0.5) > share_of_radius * 0.5 * columns) continue;
    const double height = static_cast<double>(node[i + axis]);
    Extent& extent = local.try_emplace(place, Extent{height, height}).first->second;
    extent.low = std::min(extent.low, height);
    extent.high = std::max(extent.high, height);
  }
  std::vector<double> thickness;
  for (const auto& [place, extent] : local) thickness.push_back(extent.length());
  return thickness.empty() ? 0 : median(std::move(thickness));
}

std::optional<double> flat_half_angle(const DiscState& state) {
  const Extent along = extent_along(state.node, state.load_axis);
  const auto load = static_cast<std::size_t>(state.load_axis);
  const auto across = static_cast<std::size_t>(third_axis(state.load_axis, state.disc_axis));
  double widest = -1;
  for (const bool high : {false, true}) {
    std::vector<float> pressed;
    for (std::size_t i = 0; i < state.contact_pressure.size(); ++i) {
      const double place = static_cast<double>(state.node[3 * i + load]);
      const double distance = high ? along.high - place : place - along.low;
      if (state.contact_pressure[i] > 0 && distance <= state.face_distance)
        pressed.push_back(state.node[3 * i + across]);
    }
    if (pressed.empty()) return {};
    const auto [low, top] = std::minmax_element(pressed.begin(), pressed.end());
    widest = std::max(widest, static_cast<double>(*top) - static_cast<double>(*low));
  }
  return std::asin(std::min(1.0, widest / state.diameter));
}

namespace {

/// The stage of the test, with the force of its plates on one axis.
struct Test {
  StageRows stage;
  std::vector<std::string> plates;
  int axis = 0;
  std::vector<double> force; ///< N, from disc_force, one value per row of the stage
};

std::vector<std::string> plates_of(const schema::FileReader& file, const DiametralRule& rule) {
  const std::vector<std::string> tools = file.tools();
  std::vector<std::string> shown;
  for (const std::string& tool : tools) shown.push_back(one_line(tool));
  const auto refuse = [&](const std::string& found) {
    throw InputError(fmt::format("{}: --plates: found {}, allowed: two of {}", one_line(file.path()), found,
                                 shown.empty() ? "a run with rigid tools" : fmt::format("{}", fmt::join(shown, ", "))));
  };
  if (rule.plates.empty() && tools.size() != 2) refuse(fmt::format("none, and {} tools in the run", tools.size()));
  const std::vector<std::string>& plates = rule.plates.empty() ? tools : rule.plates;
  for (const std::string& plate : plates)
    if (std::find(tools.begin(), tools.end(), plate) == tools.end()) refuse(fmt::format("'{}'", one_line(plate)));
  if (plates.size() != 2 || plates[0] == plates[1])
    refuse(fmt::format("'{}'", one_line(fmt::format("{}", fmt::join(plates, ",")))));
  return plates;
}

/// The axis on which the distance of the plates changes in the stage. Throws InputError where they do not move, or move
/// along the disc's axis or obliquely.
int axis_of_approach(const HistoryTable& history, const Test& test, int disc_axis, const std::string& path) {
  constexpr double oblique = 0.02; // of the way along the axis
  std::array<double, 3> way{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = [&](const std::string& plate) -> const std::vector<double>& {
      return history[fmt::format("tools/{}/displacement_{}", plate, k)];
    };
    const auto &a = column(test.plates[0]), &b = column(test.plates[1]);
    const RowRange rows = test.stage.rows();
    way[k] = std::abs((a[rows.last] - a[rows.first]) - (b[rows.last] - b[rows.first]));
  }
  const auto axis = static_cast<int>(std::max_element(way.begin(), way.end()) - way.begin());
  const double farthest = way[static_cast<std::size_t>(axis)];
  const auto refuse = [&](const char* finding) {
    throw InputError(fmt::format("{}: stage {}: the plates {}, allowed: plates that move across the disc's axis {} "
                                 "(--disc-axis), along another axis",
                                 path, test.stage.number, finding, "xyz"[static_cast<std::size_t>(disc_axis)]));
  };
  if (farthest == 0) refuse("do not move");
  if (axis == disc_axis) refuse("move along it");
  for (int k = 0; k < 3; ++k)
    if (k != axis && way[static_cast<std::size_t>(k)] > oblique * farthest) refuse("approach each other obliquely");
  return axis;
}

Test read_test(const schema::FileReader& file, const HistoryTable& history, const DiametralRule& rule) {
  const std::string path = one_line(file.path());
  const auto stages = stages_of(history, scenario_facts(file));
  Test test{choose_stage(stages, rule.stage, {}, file.path()), plates_of(file, rule), 0, {}};
  test.axis = axis_of_approach(history, test, rule.disc_axis, path);
  const auto part = [&](const std::string& plate) {
    return test.stage.rows().of(history[fmt::format("tools/{}/force_{}", plate, test.axis)]);
  };
  test.force = disc_force(part(test.plates[0]), part(test.plates[1]));
  const std::size_t needed = 2 * smoothing_half_rows(test.force.size()) + 1;
  if (test.force.size() < needed)
    throw InputError(fmt::format("{}: stage {} has {} rows, needed for a peak of the force: {}", path,
                                 test.stage.number, test.force.size(), needed));
  return test;
}

/// Number of the snapshot nearest to a time; without `nearest` only those not after it count.
std::optional<int> snapshot_at(const schema::FileReader& file, double time, bool nearest) {
  std::optional<int> best;
  double distance = 0;
  int number = 0;
  for (const std::string& name : file.snapshots()) {
    const double off = file.read_scalar(schema::run::snapshots_time, name) - time;
    const bool may = nearest || off <= 1e-9 * std::abs(time);
    if (may && (!best || std::abs(off) < distance)) best = number, distance = std::abs(off);
    ++number;
  }
  return best;
}

struct Disc {
  double diameter = 0, thickness = 0; ///< mm
};

/// As given, otherwise of the grains before the test: the extent along the load, as the plates find it, and the median
/// thickness.
Disc disc_of(const schema::FileReader& file, const HistoryTable& history, const Test& test, const DiametralRule& rule) {
  if (rule.diameter && rule.thickness) return {*rule.diameter, *rule.thickness};
  const auto number = snapshot_at(file, history["time"][test.stage.first], false);
  if (!number)
    throw InputError(fmt::format("{}: no snapshot before stage {}, allowed: one, or --diameter and --thickness",
                                 one_line(file.path()), test.stage.number));
  const Snapshot before = read_snapshot(file, *number);
  const double diameter = rule.diameter.value_or(extent_along(before.node, test.axis).length());
  const double thickness = rule.thickness.value_or(disc_thickness(before.node, test.axis, rule.disc_axis, diameter));
  if (!(thickness > 0))
    throw InputError(fmt::format("{}: found no thickness of the disc before stage {}, allowed: --thickness",
                                 one_line(file.path()), test.stage.number));
  return {diameter, thickness};
}

/// Half angle (rad) of the flats at a row's time: as given, otherwise from a snapshot of the stage; empty without one.
std::optional<double> half_angle_at(const schema::FileReader& file, const HistoryTable& history, const Test& test,
                                    const DiametralRule& rule, double diameter, std::size_t row) {
  if (rule.flat_angle) return 0.5 * *rule.flat_angle * std::numbers::pi / 180;
  const auto& times = history["time"];
  const auto number = snapshot_at(file, times[row], true);
  if (!number) return {};
  const Snapshot state = read_snapshot(file, *number);
  if (state.time <= times[test.stage.first]) return {};
  return flat_half_angle({state.node, state.node_field("contact_pressure").values, test.axis, rule.disc_axis, diameter,
                          rule.face_distance.value_or(0.01 * diameter)});
}

/// The bonds that have broken since the last snapshot before a test.
class CrackSince {
public:
  CrackSince(const schema::FileReader& file, const HistoryTable& history, const Test& test, int disc_axis,
             double diameter)
      : file_(file), first_(snapshot_at(file, history["time"][test.stage.first], false)) {
    if (!first_ || !has_bonds(*first_)) return;
    before_ = read_snapshot(file, *first_);
    bonds_ = read_bond_table(file, *first_);
    disc_ = {before_.node, test.axis, third_axis(test.axis, disc_axis), {}, diameter};
    for (int k = 0; k < 3; ++k) {
      const Extent extent = extent_along(before_.node, k);
      disc_.middle[static_cast<std::size_t>(k)] = 0.5 * (extent.low + extent.high);
    }
  }

  /// Whether the snapshot before the test has bonds.
  bool known() const { return !bonds_.empty(); }

  CrackSince(const CrackSince&) = delete;
  CrackSince& operator=(const CrackSince&) = delete;

  /// Up to a snapshot; empty where one of both snapshots does not exist or has no bonds, or none broke.
  std::optional<DiscCrack> until(std::optional<int> last) const {
    if (bonds_.empty() || !last || *last <= *first_ || !has_bonds(*last)) return {};
    return disc_crack(bonds_, read_bond_table(file_, *last), disc_);
  }

private:
  bool has_bonds(int number) const {
    const std::string name = snapshot_name(file_, number);
    return file_.has(schema::run::snapshots_bond_node, name) && file_.rows(schema::run::snapshots_bond_node, name) > 0;
  }

  const schema::FileReader& file_;
  std::optional<int> first_;
  Snapshot before_;
  std::vector<BondRow> bonds_;
  DiscGeometry disc_;
};

/// Number of the first snapshot not before a time; empty if there is none.
std::optional<int> snapshot_after(const schema::FileReader& file, double time) {
  int number = 0;
  for (const std::string& name : file.snapshots()) {
    if (file.read_scalar(schema::run::snapshots_time, name) >= time * (1 - 1e-9)) return number;
    ++number;
  }
  return {};
}

/// The first peak, if the rule demands it one with a crack through the centre in the snapshot after the fall. Throws
/// InputError where no snapshots with bonds show that.
FirstPeak peak_of(const std::vector<double>& force, const DiametralRule& rule, const schema::FileReader& file,
                  const Test& test, std::span<const double> times, const CrackSince& crack_since) {
  if (rule.crack_in_centre == 0) return first_peak(force, rule.drop, rule.smallest_peak);
  if (!crack_since.known() || !snapshot_after(file, times.front() * (1 + 1e-9)))
    throw InputError(fmt::format("{}: stage {}: --crack-in-centre {:g}: found no bonds in snapshots before and in the "
                                 "stage, allowed: a run with bonds, and 'snapshots' in the stage",
                                 one_line(file.path()), test.stage.number, rule.crack_in_centre));
  std::map<int, bool> split; // by snapshot
  return first_peak(force, rule.drop, rule.smallest_peak, [&](std::size_t row) {
    const std::optional<int> number = snapshot_after(file, times[row]);
    if (!number) return false;
    const auto [found, is_new] = split.try_emplace(*number, false);
    if (is_new) {
      const auto crack = crack_since.until(number);
      found->second = crack && crack->of_centre >= rule.crack_in_centre;
    }
    return found->second;
  });
}

/// Adds where bonds have broken up to the snapshot nearest to a time, or null.
void add_crack(Measurement& m, const schema::FileReader& file, const CrackSince& crack_since, double time) {
  const std::optional<DiscCrack> crack = crack_since.until(snapshot_at(file, time, true));
  const auto number = [&](double DiscCrack::*member) {
    return crack ? nlohmann::ordered_json((*crack).*member) : nlohmann::ordered_json();
  };
  m.details["broken_bond_area_mm2"] = number(&DiscCrack::area);
  m.details["broken_share_near_loaded_diameter"] = number(&DiscCrack::near_diameter);
  m.details["broken_share_in_centre"] = number(&DiscCrack::in_centre);
  m.details["broken_share_in_centre_if_even"] = number(&DiscCrack::in_centre_if_even);
  m.details["broken_share_of_centre"] = number(&DiscCrack::of_centre);
}

void add_flats(Measurement& m, std::optional<double> half_angle) {
  m.details["flat_angle_degrees"] = nullptr;
  m.details["corrected_strength_MPa"] = nullptr;
  m.details["corrected_strength_uncertainty_MPa"] = nullptr;
  if (!half_angle) return;
  const double degrees = 2 * *half_angle * 180 / std::numbers::pi, factor = flat_correction(*half_angle);
  m.details["flat_angle_degrees"] = degrees;
  m.details["corrected_strength_MPa"] = factor * m.value;
  m.details["corrected_strength_uncertainty_MPa"] = factor * m.uncertainty;
  m.brief += fmt::format(", {:.4g} MPa with flats of {:.3g} degrees", factor * m.value, degrees);
}

bool too_wide(std::optional<double> half_angle) {
  return half_angle && 2 * *half_angle * 180 / std::numbers::pi > largest_flat_angle;
}

} // namespace

std::string disc_crack_csv(const schema::FileReader& file, const HistoryTable& history, const DiametralRule& rule) {
  const Test test = read_test(file, history, rule);
  const CrackSince crack_since(file, history, test, rule.disc_axis, disc_of(file, history, test, rule).diameter);
  const std::span<const double> times = test.stage.rows().of(history["time"]);
  std::string text = "snapshot,time [s],force [N],broken_bond_area [mm^2],broken_share_near_loaded_diameter [1],"
                     "broken_share_in_centre [1],broken_share_in_centre_if_even [1],broken_share_of_centre [1]\n";
  int number = -1;
  for (const std::string& name : file.snapshots()) {
    ++number;
    const double time = file.read_scalar(schema::run::snapshots_time, name);
    if (time <= times.front() || time > times.back() * (1 + 1e-9)) continue;
    const auto after = std::lower_bound(times.begin(), times.end(), time * (1 - 1e-9));
    const auto row = static_cast<std::size_t>(after - times.begin());
    text += fmt::format("{},{:.6g},{:.6g}", number, time, test.force[std::min(row, times.size() - 1)]);
    if (const auto crack = crack_since.until(number))
      text += fmt::format(",{:.6g},{:.4g},{:.4g},{:.4g},{:.4g}\n", crack->area, crack->near_diameter, crack->in_centre,
                          crack->in_centre_if_even, crack->of_centre);
    else
      text += ",0,,,,\n";
  }
  return text;
}

namespace {

/// What was found of a test.
struct Crushed {
  const DiametralRule& rule;
  const Test& test;
  Disc disc;
  FirstPeak peak;
  double largest = 0, at_peak = 0;  ///< N, smoothed
  std::optional<double> half_angle; ///< radians, that a flat spans at the peak

  bool needs_crack() const { return rule.crack_in_centre > 0; }
  /// Whether there is no strength: the disc did not split, or its flats are too wide.
  bool none() const { return needs_crack() && (too_wide(half_angle) || !peak.falls); }
  double flat_degrees() const { return 2 * half_angle.value_or(0) * 180 / std::numbers::pi; }
};

void refuse_without_disc(const Crushed& crushed, const std::string& path) {
  if (crushed.largest > 0 && crushed.largest >= crushed.rule.smallest_peak) return;
  throw InputError(fmt::format("{}: stage {}: found a force of at most {:.3g} N on the plates, allowed: a disc between "
                               "them, with a peak of {:g} N or more",
                               path, crushed.test.stage.number, crushed.largest, crushed.rule.smallest_peak));
}

void refuse_wide_flats(const Crushed& crushed, const std::string& path) {
  if (crushed.needs_crack() || !too_wide(crushed.half_angle)) return;
  throw InputError(fmt::format("{}: found flats of 2 alpha = {:.3g} degrees at the peak, allowed: up to {:g}, beyond "
                               "which a disc does not break from its centre",
                               path, crushed.flat_degrees(), largest_flat_angle));
}

std::string method_of(const DiametralRule& rule) {
  const std::string method = fmt::format(
      "2 F / (pi D t), F the largest smoothed force of the plates before its first fall by {:g} %", 100 * rule.drop);
  return rule.crack_in_centre > 0
             ? method + fmt::format(" with {:g} % of the bonds in the centre broken", 100 * rule.crack_in_centre)
             : method;
}

/// The rows from which the peak is read.
Window window_of(const Crushed& crushed, const HistoryTable& history) {
  const Test& test = crushed.test;
  const RowRange about = ringing_rows(crushed.peak.row, test.force.size());
  const std::size_t first = test.stage.first + about.first, last = test.stage.first + about.last;
  const double to_stress = diametral_stress(1, crushed.disc.diameter, crushed.disc.thickness);
  const auto forces = range_of(test.force, about.first, about.last);
  return {test.stage.number,
          test.stage.type,
          first,
          last,
          "axial_strain",
          range_of(history["axial_strain"], first, last),
          "diametral_stress",
          {to_stress * forces[0], to_stress * forces[1]}};
}

void add_notes(Measurement& m, const Crushed& crushed) {
  const DiametralRule& rule = crushed.rule;
  if (!crushed.half_angle)
    m.notes.emplace_back("no snapshot of the stage shows pressed flats: their angle and the corrected strength are not "
                         "known; --flat-angle gives it");
  if (crushed.needs_crack() && !crushed.peak.falls)
    m.notes.push_back(fmt::format("no strength: the force, of at most {:.4g} N, does not fall by {:g} % with {:g} % of "
                                  "the bonds in the centre broken",
                                  crushed.largest, 100 * rule.drop, 100 * rule.crack_in_centre));
  else if (crushed.none())
    m.notes.push_back(fmt::format("no strength: the flats span {:.3g} degrees at the peak of {:.4g} N; beyond {:g} a "
                                  "disc does not break from its centre",
                                  crushed.flat_degrees(), crushed.at_peak, largest_flat_angle));
  else if (!crushed.peak.falls)
    m.notes.push_back(
        fmt::format("no failure: after its largest value the force does not fall by {:g} %", 100 * rule.drop));
}

/// Value, uncertainty and details, without flats and crack.
Measurement strength_of(const Crushed& crushed, const HistoryTable& history) {
  const auto [diameter, thickness] = std::pair{crushed.disc.diameter, crushed.disc.thickness};
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double force = crushed.none() ? unknown : crushed.at_peak,
               uncertainty = crushed.none() ? unknown : ringing(crushed.test.force, crushed.peak.row);
  Measurement m;
  m.metric = "diametral";
  m.value = diametral_stress(force, diameter, thickness);
  m.unit = "MPa";
  m.uncertainty = diametral_stress(uncertainty, diameter, thickness);
  m.uncertainty_meaning = "twice the scatter of the rows about parabolas over twice as many rows";
  m.method = method_of(crushed.rule);
  m.window = window_of(crushed, history);
  m.details = {{"criterion", crushed.none()       ? "none"
                             : crushed.peak.falls ? "peak"
                                                  : "largest"},
               {"force_N", force},
               {"force_uncertainty_N", uncertainty},
               {"diameter_mm", diameter},
               {"thickness_mm", thickness},
               {"plates", crushed.test.plates},
               {"load_axis", std::string(1, "xyz"[static_cast<std::size_t>(crushed.test.axis)])}};
  m.brief = fmt::format("F = {:.4g} N", force);
  return m;
}

} // namespace

Measurement measure_diametral(const schema::FileReader& file, const HistoryTable& history, const DiametralRule& rule) {
  const Test test = read_test(file, history, rule);
  const std::string path = one_line(file.path());
  const std::vector<double> smooth = smoothed(test.force);
  Crushed crushed{.rule = rule, .test = test, .disc = {}, .peak = {}, .half_angle = {}};
  crushed.largest = *std::max_element(smooth.begin(), smooth.end());
  refuse_without_disc(crushed, path);
  crushed.disc = disc_of(file, history, test, rule);
  const CrackSince crack_since(file, history, test, rule.disc_axis, crushed.disc.diameter);
  const std::span<const double> times = test.stage.rows().of(history["time"]);
  crushed.peak = peak_of(smooth, rule, file, test, times, crack_since);
  crushed.at_peak = smooth[crushed.peak.row];
  crushed.half_angle =
      half_angle_at(file, history, test, rule, crushed.disc.diameter, test.stage.first + crushed.peak.row);
  refuse_wide_flats(crushed, path);
  Measurement m = strength_of(crushed, history);
  add_flats(m, crushed.half_angle);
  add_crack(m, file, crack_since, times[crushed.peak.row]);
  add_notes(m, crushed);
  return m;
}

} // namespace mpfem
