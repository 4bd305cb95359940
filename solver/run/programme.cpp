#include "solver/run/programme.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <unistd.h>

#include "common/errors.hpp"
#include "solver/run/history_pace.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

namespace {

/// Integral of the smooth step 3 s^2 - 2 s^3 from 0 to s.
double smooth_step_integral(double s) {
  return s * s * s - 0.5 * s * s * s * s;
}

/// Growth of the box edges, in parts of their length, in which an unloading is expected to end.
constexpr double expected_growth = 0.03;
/// How much longer an unloading takes than at full speed: it leaves the last fifth of the stress slowly. Measured 1.15
/// (329 grains) and 1.58 (25 grains).
constexpr double slow_end_of_unloading = 1.3;

double volume(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
}

} // namespace

double motion_fraction(double time, double ramp) {
  const double t = std::clamp(time, 0.0, 1.0);
  // Speed rises to its plateau over `ramp`, so that the plateau speed is 1/(1 - ramp) of the mean.
  double distance = 0;
  if (ramp <= 0) return t;
  if (t < ramp)
    distance = ramp * smooth_step_integral(t / ramp);
  else if (t <= 1 - ramp)
    distance = 0.5 * ramp + (t - ramp);
  else
    distance = (1 - ramp) - ramp * smooth_step_integral((1 - t) / ramp);
  return distance / (1 - ramp);
}

StageMotion::StageMotion(const Stage& stage, const std::array<double, 3>& low, const std::array<double, 3>& high,
                         double solid_volume, double mean_stress)
    : stage_(stage), low_(low), high_(high), mean_stress_(mean_stress) {
  for (std::size_t axis = 0; axis < 3; ++axis) longest_ = std::max(longest_, high[axis] - low[axis]);
  if (stage.loading) {
    duration_ = std::numeric_limits<double>::infinity();
    return;
  }
  if (stage.hold) {
    duration_ = stage.hold->duration;
  } else if (stage.grip) {
    const auto axis = static_cast<std::size_t>(stage.grip->axis);
    const double length = high[axis] - low[axis];
    end_scale_[axis] = 1.0 + stage.grip->displacement / length;
    if (!(end_scale_[axis] > 0))
      throw InputError(
          fmt::format("{}stage '{}': key 'displacement': found {:g} mm, allowed > {:g} mm, the distance of "
                      "the grips",
                      stage.places.prefix("displacement"), stage.name, stage.grip->displacement, -length));
    if (!(2 * stage.grip->depth < length))
      throw InputError(
          fmt::format("{}stage '{}': key 'grip_depth': found {:g} mm, allowed < {:g} mm, half the distance of "
                      "the grips",
                      stage.places.prefix("grip_depth"), stage.name, stage.grip->depth, 0.5 * length));
    ramp_ = stage.grip->ramp_fraction;
    const auto& s = stage.grip->sliding;
    const double way = std::hypot(stage.grip->displacement, std::hypot(s[0], s[1], s[2]));
    duration_ = 0.5 * way / (stage.grip->speed * (1.0 - ramp_));
  } else if (stage.isotropic_unloading) {
    duration_ = std::numeric_limits<double>::infinity();
    expected_duration_ = 0.5 * longest_ * expected_growth / stage.isotropic_unloading->wall_speed;
    return;
  } else {
    const IsotropicCompaction& compaction = *stage.isotropic_compaction;
    const double density = solid_volume / volume(low, high);
    // Nearer than this, the walls would move by rounding errors.
    if (!(compaction.relative_density > density * (1 + 1e-9)))
      throw InputError(
          fmt::format("{}stage '{}': key 'relative_density': found {}, allowed more than the density at its "
                      "start, {:.4f}",
                      stage.places.prefix("relative_density"), stage.name, compaction.relative_density, density));
    end_scale_.fill(std::cbrt(density / compaction.relative_density));
    ramp_ = compaction.ramp_fraction;
    duration_ = 0.5 * longest_ * (1.0 - end_scale_[0]) / (compaction.wall_speed * (1.0 - ramp_));
  }
  expected_duration_ = duration_;
}

double StageMotion::fraction_done(double time, double mean_stress) const {
  if (!stage_.isotropic_unloading) return duration_ > 0 ? std::clamp(time / duration_, 0.0, 1.0) : 1.0;
  const double way = mean_stress_ - stage_.isotropic_unloading->mean_stress;
  return way > 0 ? std::clamp((mean_stress_ - mean_stress) / way, 0.0, 1.0) : 1.0;
}

double StageMotion::unloading_speed(double time, double mean_stress) const {
  const IsotropicUnloading& unloading = *stage_.isotropic_unloading;
  const double way = mean_stress_ - unloading.mean_stress;
  if (!(way > 0)) return 0; // nothing to unload
  const double ramp = unloading.ramp_fraction * expected_duration_;
  const double s = ramp > 0 ? std::min(time / ramp, 1.0) : 1.0;
  // The walls leave the last fifth of the stress ever more slowly, so that the packing is nearly at rest at the end.
  const double left = (mean_stress - unloading.mean_stress) / way;
  return unloading.wall_speed * (3 - 2 * s) * s * s *
         std::clamp(5 * left, slowest_unloading(unloading.mean_stress, mean_stress_), 1.0);
}

void StageMotion::move(Walls& walls, double time, double step, double mean_stress) const {
  if (stage_.isotropic_unloading) {
    const double half = unloading_speed(time, mean_stress) * step / longest_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      walls.low[axis] -= half * (high_[axis] - low_[axis]);
      walls.high[axis] += half * (high_[axis] - low_[axis]);
    }
    return;
  }
  const double fraction = duration_ > 0 ? motion_fraction(time / duration_, ramp_) : 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double scale = 1.0 + (end_scale_[axis] - 1.0) * fraction;
    const double centre = 0.5 * (low_[axis] + high_[axis]), half = 0.5 * scale * (high_[axis] - low_[axis]);
    walls.low[axis] = centre - half;
    walls.high[axis] = centre + half;
  }
}

std::array<double, 3> StageMotion::sliding(double time) const {
  if (!stage_.grip) return {};
  std::array<double, 3> result = stage_.grip->sliding;
  for (double& component : result) component *= motion_fraction(time / duration_, ramp_);
  return result;
}

bool StageMotion::reached(const Walls& walls, double mean_stress) const {
  if (!stage_.isotropic_unloading) return false;
  const double target = stage_.isotropic_unloading->mean_stress;
  const double way = mean_stress_ - target;
  // Where there is nothing to unload the walls do not move, so that a stress that rises a little would never be met.
  if (!(way > 0) || mean_stress <= target + unloading_tolerance(target, way)) return true;
  constexpr double largest_growth = 0.3;
  if (walls.high[0] - walls.low[0] > (1 + largest_growth) * (high_[0] - low_[0]))
    throw SimulationError(fmt::format("stage '{}': the mean stress is still {:.3g} MPa, target {:g} MPa, after the box "
                                      "grew by {:.0f} % in length",
                                      stage_.name, mean_stress, target, 100 * largest_growth));
  return false;
}

std::string StageMotion::end_text() const {
  if (stage_.hold) return fmt::format("duration {:g} s", stage_.hold->duration);
  if (stage_.grip) return fmt::format("displacement {:g} mm", stage_.grip->displacement);
  if (stage_.isotropic_unloading) return fmt::format("mean stress {:g} MPa", stage_.isotropic_unloading->mean_stress);
  if (stage_.isotropic_compaction)
    return fmt::format("relative density {:g}", stage_.isotropic_compaction->relative_density);
  return {};
}

std::string unreachable_stress(const Stage& stage, double mean_stress) {
  constexpr double already_there = 0.01; // of the target
  const auto text = [&](const char* what, double target) {
    return fmt::format(
        "stage '{}': key 'mean_stress': found {:g} MPa, to be reached by {}, but {:.4g} MPa act when the "
        "stage begins",
        stage.name, target, what, mean_stress);
  };
  if (const auto& unloading = stage.isotropic_unloading;
      unloading && mean_stress < (1 - already_there) * unloading->mean_stress)
    return text("unloading", unloading->mean_stress);
  if (const auto& loading = stage.loading;
      loading && loading->path == LoadingPath::isotropic && mean_stress >= *loading->ends.mean_stress)
    return text("compaction", *loading->ends.mean_stress);
  return {};
}

std::vector<StageForecast> forecast(const Scenario& scenario, std::int64_t first_stage, std::array<double, 3> low,
                                    std::array<double, 3> high, const Model& model) {
  std::vector<StageForecast> forecasts;
  StageForecast f{.low = low, .high = high};
  for (auto s = static_cast<std::size_t>(first_stage); s < scenario.stages.size(); ++s) {
    const Stage& stage = scenario.stages[s];
    if (stage.loading) {
      const LoadingControl control(stage, f.low, f.high, sample_of(model));
      f.duration = control.expected_duration();
      f.sure = false;
      const auto scale = control.expected_scale();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double cut = 0.5 * (1 - scale[axis]) * (f.high[axis] - f.low[axis]);
        f.low[axis] += cut, f.high[axis] -= cut;
      }
    } else if (stage.isotropic_compaction && !f.sure &&
               stage.isotropic_compaction->relative_density * (1 - 1e-9) <=
                   model.total_reference_volume() / volume(f.low, f.high)) {
      f.duration = 0; // nobody knows yet whether that is possible
    } else {
      const StageMotion motion(stage, f.low, f.high, model.total_reference_volume(), 0.0);
      f.duration = motion.expected_duration();
      if (stage.isotropic_unloading) f.sure = false, f.duration *= slow_end_of_unloading;
      Walls walls{.low = f.low, .high = f.high};
      motion.move(walls, motion.expected_duration(), 0.0, 0.0);
      f.low = walls.low, f.high = walls.high;
    }
    forecasts.push_back(f);
  }
  return forecasts;
}

namespace {

/// A step that is no step tells of units that cannot be meant.
void check_stable_step(double step) {
  constexpr double smallest = 1e-30; // s
  if (!(step >= smallest && std::isfinite(step)))
    throw InputError(
        fmt::format("the stable step is {:.3g} s, allowed a finite number >= {:g} s: material.youngs_modulus "
                    "(MPa), material.density (tonne/mm^3), contact.stiffness or the packing (mm) cannot be "
                    "in these units",
                    step, smallest));
}

/// A run that would not end within years is refused: a core makes some 1e9 steps of the smallest model a day.
void check_steps(const Scenario& scenario, std::int64_t first_stage, const std::vector<StageForecast>& stages,
                 double stable_step) {
  constexpr double most = 1e10;
  double steps = 0;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const double own = stages[i].duration / stable_step;
    steps += own;
    if (!(steps <= most))
      throw InputError(fmt::format(
          "stage '{}': takes {:.3g} steps of {:.3g} s ({:.3g} s), allowed at most {:g} steps in "
          "all stages: raise its speed or shorten it",
          scenario.stages[static_cast<std::size_t>(first_stage) + i].name, own, stable_step, stages[i].duration, most));
  }
}

/// Rows of the history stay in memory until the run ends, and once more while they are written.
void check_history(const Scenario& scenario, std::int64_t first_stage) {
  constexpr double copies = 3, largest_part = 0.5; // of the machine's memory
  const double stages = static_cast<double>(scenario.stages.size()) - static_cast<double>(first_stage);
  const double rows = stages * most_rows(scenario.output.history_rows);
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (const double needed = copies * rows * static_cast<double>(sizeof(HistoryRow)); needed > largest_part * memory)
    throw InputError(
        fmt::format("key 'output.history_rows': found {}, up to {:.3g} rows in {:.0f} stages may need {:.3g} "
                    "GB, allowed half of the machine's {:.3g} GB",
                    scenario.output.history_rows, rows, stages, 1e-9 * needed, 1e-9 * memory));
}

} // namespace

void check_programme(const Scenario& scenario, std::int64_t first_stage, std::array<double, 3> low,
                     std::array<double, 3> high, const Model& model, double stable_step) {
  constexpr double largest_travel = 0.05; // of h a step; a penetration of that size in one step is an impact
  check_stable_step(stable_step);
  check_steps(scenario, first_stage, forecast(scenario, first_stage, low, high, model), stable_step);
  check_history(scenario, first_stage);
  const double smallest_size = *std::min_element(model.element_size.begin(), model.element_size.end());
  for (auto s = static_cast<std::size_t>(first_stage); s < scenario.stages.size(); ++s) {
    const Stage& stage = scenario.stages[s];
    const double fastest = largest_travel * smallest_size / stable_step;
    const auto check = [&](const char* key, double speed) {
      if (speed > fastest)
        throw InputError(fmt::format(
            "{}stage '{}': key '{}': found {:g} mm/s, allowed at most {:.4g} mm/s here ({} of an element in a "
            "stable step of {:.3g} s)",
            stage.places.prefix(std::string(key).substr(0, std::string(key).find('.'))), stage.name, key, speed,
            fastest, largest_travel, stable_step));
    };
    if (stage.quasi_static)
      check("quasi_static.fastest_speed", stage.quasi_static->fastest_speed);
    else
      check(stage.grip ? "speed" : "wall_speed", stage.speed());
    if (stage.loading && (stage.loading->path == LoadingPath::triaxial || stage.loading->path == LoadingPath::probe ||
                          stage.loading->path == LoadingPath::held))
      // servos hurry with the stage
      check("servo_speed",
            stage.loading->servo_speed *
                std::max(1.0, stage.quasi_static ? stage.quasi_static->fastest_speed / stage.speed() : 1.0));
  }
}

} // namespace mpfem
