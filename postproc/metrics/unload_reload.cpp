#include "postproc/metrics/unload_reload.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/fits/statistics.hpp"

namespace mpfem {

namespace {

/// First row, from `row` on, after which the strain moves against `sign` (1 rising, -1 falling).
std::size_t next_turn(const std::vector<double>& strain, std::size_t row, double sign) {
  while (row + 1 < strain.size() && sign * (strain[row + 1] - strain[row]) >= 0) ++row;
  return row;
}

/// Leaves out rows at regular intervals, so that there are at most about a million pairs for Theil-Sen.
std::vector<double> thinned(const std::vector<double>& column, RowRange rows) {
  constexpr std::size_t most_rows = 1500;
  std::vector<double> kept;
  for (std::size_t row = rows.first; row <= rows.last; row += 1 + rows.count() / most_rows) kept.push_back(column[row]);
  return kept;
}

Line branch(const StageCurve& c, RowRange rows) {
  return theil_sen_line(thinned(c.axial_strain, rows), thinned(c.axial_stress, rows));
}

/// The part of the loop's last step up to where the strain or the stress of its top is reached, whichever comes first.
double closing_share(const StageCurve& c, const UnloadReloadLoop& loop) {
  double share = 1;
  for (const auto* column : {&c.axial_strain, &c.axial_stress}) {
    const double before = (*column)[loop.closed - 1], after = (*column)[loop.closed], top = (*column)[loop.top];
    if (after > top && after > before) share = std::min(share, (top - before) / (after - before));
  }
  return share;
}

/// Area of the loop (MPa): stress over strain, once around, by trapezoids. The last step ends where the loop closes;
/// a straight line leads from there to its top.
double loop_area(const StageCurve& c, const UnloadReloadLoop& loop) {
  double area = 0, strain = c.axial_strain[loop.top], stress = c.axial_stress[loop.top];
  const auto move_to = [&](double next_strain, double next_stress) {
    area += 0.5 * (stress + next_stress) * (next_strain - strain);
    strain = next_strain;
    stress = next_stress;
  };
  for (std::size_t row = loop.top + 1; row < loop.closed; ++row) move_to(c.axial_strain[row], c.axial_stress[row]);
  const double share = closing_share(c, loop);
  move_to(strain + share * (c.axial_strain[loop.closed] - strain),
          stress + share * (c.axial_stress[loop.closed] - stress));
  move_to(c.axial_strain[loop.top], c.axial_stress[loop.top]);
  return area;
}

const UnloadReloadLoop& choose_loop(const std::vector<UnloadReloadLoop>& loops, int number, const StageCurve& c) {
  const int count = static_cast<int>(loops.size());
  if (count == 0)
    throw InputError(fmt::format("{}: stage {}: found no loop in which the axial strain falls and rises again, "
                                 "allowed: an axial loading with an unloading and a reloading in it",
                                 c.path, c.stage));
  const int index = number < 0 ? count + number : number;
  if (index < 0 || index >= count)
    throw InputError(
        fmt::format("{}: --loop: found {}, allowed: 0 … {}, or -1 for the last", c.path, number, count - 1));
  return loops[static_cast<std::size_t>(index)];
}

} // namespace

std::vector<UnloadReloadLoop> unload_reload_loops(const StageCurve& c) {
  const std::vector<double>& strain = c.axial_strain;
  std::vector<UnloadReloadLoop> loops;
  for (std::size_t top = next_turn(strain, 0, 1); top + 1 < strain.size();) {
    const std::size_t bottom = next_turn(strain, top, -1), end = next_turn(strain, bottom, 1);
    if (end == bottom) break; // the curve ends unloaded
    std::size_t closed = bottom;
    while (closed < end && strain[closed] < strain[top] && c.axial_stress[closed] < c.axial_stress[top]) ++closed;
    if (top > 0 && bottom > top + 1 && closed > bottom + 1) loops.push_back({top, bottom, closed});
    top = end;
  }
  return loops;
}

Measurement unload_reload_modulus(const StageCurve& c, int number) {
  const UnloadReloadLoop loop = choose_loop(unload_reload_loops(c), number, c);
  const double strain = c.axial_strain[loop.top] - c.axial_strain[loop.bottom];
  const double stress = c.axial_stress[loop.top] - c.axial_stress[loop.bottom];
  const Line unloading = branch(c, {loop.top, loop.bottom}), reloading = branch(c, {loop.bottom, loop.closed});
  const auto since_top = [&](const std::vector<double>& column) { return column[loop.closed] - column[loop.top]; };
  const double given_back = c.axial_work[loop.top] - c.axial_work[loop.bottom];
  Measurement m;
  m.metric = "unload-reload-modulus";
  m.value = 0.5 * (unloading.slope + reloading.slope);
  if (!(m.value > 0))
    throw InputError(fmt::format(
        "{}: stage {}: the stress does not fall in the loop, allowed: a loop with an unloading", c.path, c.stage));
  m.unit = "MPa";
  m.uncertainty =
      0.5 * std::hypot(unloading.slope_half_width, reloading.slope_half_width, unloading.slope - reloading.slope);
  m.uncertainty_meaning =
      "half of the 95 % interval of the mean slope, and half of the difference of both slopes, added in quadrature";
  m.window.stage = c.stage;
  m.window.stage_type = c.type;
  m.window.first_row = c.first_row + loop.top;
  m.window.last_row = c.first_row + loop.closed;
  m.window.strain = {c.axial_strain[loop.bottom], c.axial_strain[loop.top]};
  m.window.stress = {c.axial_stress[loop.bottom], c.axial_stress[loop.top]};
  m.method = "mean of the Theil-Sen slopes of axial stress over axial strain while the loop unloads and reloads";
  m.details = {{"slope_of_unloading_MPa", unloading.slope},
               {"slope_of_reloading_MPa", reloading.slope},
               {"slope_between_turning_points_MPa", stress / strain},
               {"strain_of_loop", strain},
               {"loop_area_MPa", loop_area(c, loop)},
               {"plastic_dissipation_in_loop_mJ", since_top(c.plastic_dissipation)},
               {"damage_dissipation_in_loop_mJ", since_top(c.damage_dissipation)},
               {"work_given_back_mJ", given_back},
               {"damage_over_work_given_back", nullptr},
               {"unconfined", c.unconfined}};
  if (given_back > 0) m.details["damage_over_work_given_back"] = since_top(c.damage_dissipation) / given_back;
  m.brief = fmt::format("axial strain {:.4g} … {:.4g}, slopes {:.5g} and {:.5g} MPa", m.window.strain[0],
                        m.window.strain[1], unloading.slope, reloading.slope);
  return m;
}

Measurement measure_unload_reload_modulus(const schema::FileReader& file, std::optional<int> number, int loop) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const StageRows& chosen = need_stage_of_type(stages, number, {"unconfined_compression"}, file.path());
  StageRows rows = chosen;
  const auto here = static_cast<std::size_t>(&chosen - stages.data());
  for (std::size_t s = here; s > 0 && stages[s - 1].type == chosen.type; --s) rows.first = stages[s - 1].first;
  for (std::size_t s = here + 1; s < stages.size() && stages[s].type == chosen.type; ++s) rows.last = stages[s].last;
  return unload_reload_modulus(stage_curve(history, rows, file.path()), loop);
}

} // namespace mpfem
