#include "solver/run/stage_forecast.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "common/errors.hpp"
#include "solver/run/history_schedule.hpp"
#include "solver/run/needs.hpp"
#include "solver/run/plausibility.hpp"
#include "solver/run/stages/isotropic_compaction.hpp"

namespace mpfem {

namespace {

/// How much longer an unloading takes than at full speed: it covers the last fifth of the stress slowly. Measured 1.15
/// (329 grains) and 1.58 (25 grains).
constexpr double slow_end_of_unloading = 1.3;

/// Fraction of the way to its other ends after which a loading is expected to end by a stress drop. Measured 0.45 to
/// 0.56 (unconfined compression, 25 grains).
constexpr double way_to_stress_drop = 0.5;

/// The time that a stage takes, over the time that its control expects.
double time_factor(const StageType& type) {
  if (std::holds_alternative<IsotropicUnloading>(type)) return slow_end_of_unloading;
  const LoadingEnds* ends = loading_ends(type);
  return ends && ends->stress_drop ? way_to_stress_drop : 1.0;
}

/// A compaction whose start is not known beforehand and which may have nothing left to do.
bool may_be_done(const Stage& stage, const StageForecast& before, const Model& model) {
  const auto* compaction = std::get_if<IsotropicCompaction>(&stage.type);
  return compaction && !before.end_is_known &&
         compaction->relative_density * (1 - 1e-9) <= model.total_reference_volume() / before.cell.volume();
}

/// An absurd step shows that the input is in other units.
void check_stable_step(double step) {
  constexpr double smallest = 1e-30; // s
  if (!(step >= smallest && std::isfinite(step)))
    throw InputError(
        fmt::format("the stable step is {:.3g} s, allowed: a finite number >= {:g} s; material.youngs_modulus "
                    "(MPa), material.density (tonne/mm^3), contact.stiffness or the packing (mm) cannot be "
                    "in these units",
                    step, smallest));
}

/// A key of a stage and its value, as messages name them.
struct SpeedKey {
  std::string place; ///< "FILE:LINE:COLUMN: "
  std::string key;
  double speed = 0;     ///< mm/s
  bool is_given = true; ///< false: by default
};

/// The key of a stage's own speed: that of its walls, grips or tools.
SpeedKey speed_key(const Stage& stage) {
  const char* key = std::holds_alternative<GripMotion>(stage.type)    ? "speed"
                    : std::holds_alternative<ToolLoading>(stage.type) ? "drive"
                                                                      : "wall_speed";
  return {stage.places.prefix(key), key, driven_speed(stage.type)};
}

/// The key of the largest speed at which a stage may be driven.
SpeedKey fastest_key(const Stage& stage) {
  if (!stage.quasi_static) return speed_key(stage);
  const KeyPlaces& places = stage.quasi_static->places;
  return {places.prefix("fastest_speed"), "quasi_static.fastest_speed", stage.quasi_static->fastest_speed,
          places.has("fastest_speed")};
}

/// The key of the largest speed of walls or tools that are held at a stress.
SpeedKey servo_key(const Stage& stage, double speed) {
  if (std::holds_alternative<ToolLoading>(stage.type)) return {stage.places.prefix("drive"), "drive", speed};
  return {stage.places.prefix("servo_speed"), "servo_speed", speed, stage.places.has("servo_speed")};
}

/// "stage 'press': key 'wall_speed': found 5 mm/s": what a message says first of a stage that is too slow. Stages that
/// drive nothing have a duration (s), or tools that hold a push.
std::string slow_text(const Stage& stage, double duration) {
  const bool drives = driven_speed(stage.type) > 0;
  if (!drives && stage.places.has("duration"))
    return fmt::format("{}stage '{}': key 'duration': found {:g} s", stage.places.prefix("duration"), stage.name,
                       duration);
  const SpeedKey key = drives ? speed_key(stage) : servo_key(stage, servo_speed(stage.type).value_or(0));
  return fmt::format("{}stage '{}': key '{}': found {:g} mm/s", key.place, stage.name, key.key, key.speed);
}

/// A run that would not end within years is refused: a core does some 1e9 steps of the smallest model a day.
void check_steps(const Scenario& scenario, std::int64_t first_stage, const std::vector<StageForecast>& stages,
                 double stable_step) {
  constexpr double most = 1e10;
  double steps = 0;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const double own = stages[i].duration / stable_step;
    steps += own;
    if (!(steps <= most))
      throw InputError(
          fmt::format("{}, which takes {:.3g} steps of {:.3g} s ({:.3g} s), allowed: at most {:g} steps in all stages; "
                      "raise its speed or shorten it{}",
                      slow_text(scenario.stages[static_cast<std::size_t>(first_stage) + i], stages[i].duration), own,
                      stable_step, stages[i].duration, most, implausible_values_hint(scenario)));
  }
}

/// Rows of the history stay in memory until the run ends: in a vector that may have room for twice as many, and once
/// more while they are written.
void check_history(const Scenario& scenario, std::int64_t first_stage) {
  constexpr double copies = 3, largest_part = 0.5; // of the machine's memory
  const double stages = static_cast<double>(scenario.stages.size()) - static_cast<double>(first_stage);
  const double rows = stages * most_rows(scenario.output.history_rows);
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (const double needed = copies * rows * bytes_of_row(scenario); needed > largest_part * memory)
    throw InputError(fmt::format(
        "{}key 'output.history_rows': {} {}, up to {:.3g} rows in {:.0f} stages may need {:.3g} GB, allowed: up to "
        "half of the machine's {:.3g} GB",
        scenario.output_places.prefix("history_rows"),
        scenario.output_places.has("history_rows") ? "found" : "missing, by default", scenario.output.history_rows,
        rows, stages, 1e-9 * needed, 1e-9 * memory));
}

/// Refuses a speed at which walls would hit grains hard within one step. `faster`: by how much quasi_static may raise
/// it. `hint` ends the message.
void check_speed(const Stage& stage, const SpeedKey& key, double faster, double size, double stable_step,
                 const std::string& hint) {
  constexpr double largest_travel = 0.05; // of h a step; a penetration of that size in one step is an impact
  const double allowed = largest_travel * size / stable_step;
  if (faster * key.speed <= allowed) return;
  throw InputError(fmt::format("{}stage '{}': key '{}': {} {:g} mm/s{}, allowed: at most {:.4g} mm/s here ({} of an "
                               "element in a stable step of {:.3g} s){}",
                               key.place, stage.name, key.key, key.is_given ? "found" : "missing, by default",
                               key.speed, faster > 1 ? fmt::format(" times {:g} with quasi_static", faster) : "",
                               allowed, largest_travel, stable_step, hint));
}

} // namespace

std::string unreachable_stress(const Stage& stage, double mean_stress) {
  const auto text = [&](const char* what, double target) {
    return fmt::format(
        "stage '{}': key 'mean_stress': found {:g} MPa, to be reached by {}, but {:.4g} MPa act when the "
        "stage begins",
        stage.name, target, what, mean_stress);
  };
  if (const auto* unloading = std::get_if<IsotropicUnloading>(&stage.type);
      unloading && mean_stress < (1 - already_there) * unloading->mean_stress)
    return text("unloading", unloading->mean_stress);
  if (const auto* loading = std::get_if<IsotropicLoading>(&stage.type); loading && mean_stress >= loading->mean_stress)
    return text("compaction", loading->mean_stress);
  return {};
}

std::vector<StageForecast> forecast(const Scenario& scenario, std::int64_t first_stage, const Cell& cell,
                                    const Model& model) {
  std::vector<StageForecast> forecasts;
  StageForecast f{.cell = cell};
  const Sample sample = sample_of(model);
  for (auto s = static_cast<std::size_t>(first_stage); s < scenario.stages.size(); ++s) {
    const Stage& stage = scenario.stages[s];
    if (may_be_done(stage, f, model)) {
      f.duration = 0;
      f.description = IsotropicCompactionControl::description;
    } else {
      const auto control = make_stage_control(stage, {f.cell, 0.0, sample});
      f.duration = time_factor(stage.type) * control->expected_duration();
      f.description = control->describe();
      if (const std::string why = control->unreachable_end(); f.end_is_known && !why.empty()) throw InputError(why);
      if (!std::isfinite(control->duration())) f.end_is_known = false;
      control->expect_end(f.cell);
    }
    forecasts.push_back(f);
  }
  return forecasts;
}

void check_stages(const Scenario& scenario, std::int64_t first_stage, const Cell& cell, const Model& model,
                  double stable_step) {
  check_stable_step(stable_step);
  check_steps(scenario, first_stage, forecast(scenario, first_stage, cell, model), stable_step);
  check_history(scenario, first_stage);
  const double size = *std::min_element(model.element_size.begin(), model.element_size.end());
  const std::string hint = implausible_values_hint(scenario);
  for (auto s = static_cast<std::size_t>(first_stage); s < scenario.stages.size(); ++s) {
    const Stage& stage = scenario.stages[s];
    const SpeedKey fastest = fastest_key(stage);
    check_speed(stage, fastest, 1, size, stable_step, hint);
    // Servos speed up in the same ratio as the stage.
    const double speed = driven_speed(stage.type), faster = speed > 0 ? std::max(1.0, fastest.speed / speed) : 1.0;
    if (const auto servo = servo_speed(stage.type))
      check_speed(stage, servo_key(stage, *servo), faster, size, stable_step, hint);
  }
}

} // namespace mpfem
