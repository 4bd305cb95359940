#include "postproc/metrics/modulus.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/smoothing.hpp"

namespace mpfem {

namespace {

constexpr std::size_t shortest_window = 7;   // two halves with four rows each, the middle one shared
constexpr std::size_t longest_window = 1500; // rows: about a million pairs for Theil-Sen

struct Halves {
  double first = 0, second = 0, whole = 0; ///< slopes, MPa
  double deviation = 0;                    ///< standard deviation of their difference, from the halves' scatter
  double change() const { return std::abs(second - first); }
};

bool strain_rises(const StageCurve& c, RowRange rows) {
  const std::size_t middle = (rows.first + rows.last) / 2;
  return c.axial_strain[middle] > c.axial_strain[rows.first] && c.axial_strain[rows.last] > c.axial_strain[middle];
}

Halves halves_of(const StageCurve& c, RowRange rows) {
  const std::size_t middle = (rows.first + rows.last) / 2;
  const auto line = [&](RowRange part) { return least_squares_line(part.of(c.axial_strain), part.of(c.axial_stress)); };
  const Line first = line({rows.first, middle}), second = line({middle, rows.last});
  const auto deviation = [&](const Line& half, std::size_t count) {
    return count > 2 ? half.slope_half_width / student_t_95(count - 2) : 0.0;
  };
  return {first.slope, second.slope, line(rows).slope,
          std::hypot(deviation(first, middle - rows.first + 1), deviation(second, rows.last - middle + 1))};
}

struct Choice {
  RowRange rows;
  std::string limit; ///< what ends the window
  std::string note;  ///< what a reader must know about it; may be empty
  bool meets_rule = true;
};

Choice window_by_hand(const StageCurve& c, std::array<double, 2> range) {
  std::size_t begin = 0, end = 0;
  const auto peak = std::max_element(c.axial_strain.begin(), c.axial_strain.end()) - c.axial_strain.begin();
  const auto rows = static_cast<std::size_t>(peak) + 1;
  while (begin < rows && c.axial_strain[begin] < range[0]) ++begin;
  end = begin;
  while (end + 1 < rows && c.axial_strain[end + 1] <= range[1]) ++end;
  if (begin >= rows || end + 1 < begin + 3 || !strain_rises(c, {begin, end}))
    throw InputError(fmt::format("{}: --strain-range: found {:g},{:g} with fewer than 3 rows of stage {}, allowed: 3 "
                                 "or more; its axial strain ends at {:g}",
                                 c.path, range[0], range[1], c.stage, c.axial_strain.back()));
  return {{begin, end}, "the strain range given", ""};
}

/// The rise of the smoothed stress from its lowest value to its peak, in which a window is sought.
struct Rise {
  RowRange rows;
  std::vector<double> smooth; ///< MPa, of all rows
  double over(RowRange part) const { return smooth[part.last] - smooth[part.first]; }
};

/// Throws InputError where the stage is not an axial loading.
Rise find_rise(const StageCurve& c) {
  if (c.rows() < shortest_window)
    throw InputError(
        fmt::format("{}: stage {} has {} rows, needed for a modulus: {}", c.path, c.stage, c.rows(), shortest_window));
  std::vector<double> smooth = smoothed(c.axial_stress);
  const auto peak = static_cast<std::size_t>(std::max_element(smooth.begin(), smooth.end()) - smooth.begin());
  const auto begin = static_cast<std::size_t>(
      std::min_element(smooth.begin(), smooth.begin() + static_cast<std::ptrdiff_t>(peak) + 1) - smooth.begin());
  if (peak + 1 < begin + shortest_window || !strain_rises(c, {begin, peak}))
    throw InputError(
        fmt::format("{}: stage {} is not an axial loading: {} rows from its lowest axial stress to the highest, "
                    "needed: {} with rising axial strain",
                    c.path, c.stage, peak - begin + 1, shortest_window));
  return {{begin, peak}, std::move(smooth)};
}

/// The rows that a window may span by the rule's share of the rise.
RowRange allowed_rows(const Rise& rise, const ModulusRule& rule) {
  const double highest = rise.smooth[rise.rows.first] + rule.stress_fraction * rise.over(rise.rows);
  std::size_t end = rise.rows.first;
  while (end < rise.rows.last && rise.smooth[end + 1] <= highest) ++end;
  return {rise.rows.first, std::max(end, rise.rows.first + shortest_window - 1)};
}

/// The longest window, from the first of the allowed rows, in which damage and change of slope meet the rule.
std::optional<Choice> longest_window_in(const StageCurve& c, const ModulusRule& rule, RowRange allowed) {
  std::string ended_by = fmt::format("{:g} % of the rise in stress", 100 * rule.stress_fraction);
  const std::size_t first = allowed.first;
  for (std::size_t last = allowed.last; last + 1 >= first + shortest_window; --last) {
    const double damage = c.damage_dissipation[last] - c.damage_dissipation[first];
    if (damage > rule.damage_share * (c.axial_work[last] - c.axial_work[first])) {
      ended_by = fmt::format("damage above {:g} % of the axial work", 100 * rule.damage_share);
      continue;
    }
    if (!strain_rises(c, {first, last})) continue;
    const Halves slopes = halves_of(c, {first, last});
    if (slopes.change() <= rule.slope_change * slopes.whole) return Choice{{first, last}, ended_by, ""};
    ended_by = fmt::format("a change of slope above {:g} %", 100 * rule.slope_change);
  }
  return {};
}

/// Window without the toe, where the slope still grows over the first fifth of the rise: there not all of the sample
/// responds elastically yet. The window begins at the first row from which it spans a fifth of the rise. Empty without
/// a toe.
std::optional<Choice> window_after_toe(const StageCurve& c, const ModulusRule& rule, const Rise& rise,
                                       RowRange allowed) {
  const double fifth = 0.2 * rise.over(rise.rows);
  RowRange toe{allowed.first, allowed.first + shortest_window - 1};
  while (toe.last < allowed.last && rise.smooth[toe.last] < rise.smooth[toe.first] + fifth) ++toe.last;
  if (!strain_rises(c, toe)) return {};
  const Halves slopes = halves_of(c, toe);
  if (!(slopes.second - slopes.first > rule.slope_change * slopes.whole + 2 * slopes.deviation)) return {};
  for (std::size_t first = allowed.first + 1; first + shortest_window <= allowed.last + 1; ++first)
    if (auto choice = longest_window_in(c, rule, {first, allowed.last}); choice && rise.over(choice->rows) >= fifth) {
      choice->note = fmt::format("the slope grows at first: {} rows of this toe are left out", first - allowed.first);
      return choice;
    }
  return {};
}

/// For the case that no window meets the rule.
Choice shortest_window_at(const StageCurve& c, const ModulusRule& rule, std::size_t begin) {
  const RowRange shortest{begin, begin + shortest_window - 1};
  if (!strain_rises(c, shortest))
    throw InputError(fmt::format("{}: stage {}: the axial strain does not rise over the {} rows after its lowest axial "
                                 "stress, allowed: an axial compression",
                                 c.path, c.stage, shortest_window));
  return {shortest, "nothing: no window meets the rule",
          fmt::format("no window meets the rule for slope ({:g} %) and damage ({:g} %): the first {} rows",
                      100 * rule.slope_change, 100 * rule.damage_share, shortest_window),
          false};
}

Choice window_by_rule(const StageCurve& c, const ModulusRule& rule) {
  const Rise rise = find_rise(c);
  const RowRange allowed = allowed_rows(rise, rule);
  if (const auto choice = window_after_toe(c, rule, rise, allowed)) return *choice;
  if (const auto choice = longest_window_in(c, rule, allowed)) return *choice;
  return shortest_window_at(c, rule, allowed.first);
}

/// Leaves out rows at regular intervals, so that at most `longest_window` are left.
std::vector<double> thinned(std::span<const double> values) {
  const std::size_t stride = (values.size() + longest_window - 1) / longest_window;
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); i += stride) kept.push_back(values[i]);
  return kept;
}

} // namespace

Measurement modulus(const StageCurve& c, const ModulusRule& rule) {
  const Choice choice = rule.strain_range ? window_by_hand(c, *rule.strain_range) : window_by_rule(c, rule);
  const RowRange rows = choice.rows;
  const Line line = theil_sen_line(thinned(rows.of(c.axial_strain)), thinned(rows.of(c.axial_stress)));
  if (!(line.slope > 0))
    throw InputError(fmt::format("{}: stage {}: the axial stress does not rise with the axial strain (slope {:.3g} MPa "
                                 "over {} rows), allowed: an axial compression",
                                 c.path, c.stage, line.slope, rows.count()));
  const Halves slopes = halves_of(c, rows);
  Measurement m;
  m.metric = "modulus";
  m.value = line.slope;
  m.unit = "MPa";
  m.uncertainty = std::hypot(line.slope_half_width, slopes.change());
  m.uncertainty_meaning = "half of the slope's 95 % interval and the difference of the halves' slopes, in quadrature";
  m.window.stage = c.stage;
  m.window.stage_type = c.type;
  m.window.first_row = c.first_row + rows.first;
  m.window.last_row = c.first_row + rows.last;
  m.window.strain = {c.axial_strain[rows.first], c.axial_strain[rows.last]};
  m.window.stress = range_of(c.axial_stress, rows.first, rows.last);
  m.method =
      fmt::format("Theil-Sen slope of axial stress over {} rows; the window ends with {}", rows.count(), choice.limit);
  m.details = {{"half_of_95_percent_interval_MPa", line.slope_half_width},
               {"slope_of_first_half_MPa", slopes.first},
               {"slope_of_second_half_MPa", slopes.second},
               {"scatter_of_stress_MPa", line.scatter},
               {"damage_over_axial_work", nullptr},
               {"unconfined", c.unconfined},
               {"window_meets_rule", choice.meets_rule},
               {"relative_density_at_start", c.relative_density.front()}};
  if (const double work = c.axial_work[rows.last] - c.axial_work[rows.first]; work > 0)
    m.details["damage_over_axial_work"] = (c.damage_dissipation[rows.last] - c.damage_dissipation[rows.first]) / work;
  m.brief = fmt::format("axial strain {:.4g} … {:.4g}, window ends with {}", m.window.strain[0], m.window.strain[1],
                        choice.limit);
  if (!choice.note.empty()) m.notes.push_back(choice.note);
  if (!c.unconfined)
    m.notes.emplace_back(
        "the lateral walls carry load: the slope is a Young's modulus only if their stress is constant");
  return m;
}

Measurement measure_modulus(const schema::FileReader& file, std::optional<int> number, const ModulusRule& rule,
                            std::optional<double> youngs_modulus) {
  const HistoryTable history(file);
  const ScenarioFacts facts = scenario_facts(file);
  const auto stages = stages_of(history, facts);
  const StageRows& stage = choose_stage(stages, number, {"unconfined_compression"}, file.path());
  Measurement m = modulus(stage_curve(history, stage, file.path()), rule);
  const auto& density = history["relative_density"];
  m.details["relative_density_max"] =
      *std::max_element(density.begin(), density.begin() + static_cast<std::ptrdiff_t>(stage.first) + 1);
  const std::optional<double> grains = youngs_modulus ? youngs_modulus : facts.youngs_modulus;
  m.details["youngs_modulus_of_grains_MPa"] = nullptr;
  m.details["modulus_over_grains"] = nullptr;
  m.details["modulus_over_grains_uncertainty"] = nullptr;
  if (grains && *grains > 0) {
    m.details["youngs_modulus_of_grains_MPa"] = *grains;
    m.details["modulus_over_grains"] = m.value / *grains;
    m.details["modulus_over_grains_uncertainty"] = m.uncertainty / *grains;
  }
  return m;
}

} // namespace mpfem
