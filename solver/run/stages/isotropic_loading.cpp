#include "solver/run/stages/isotropic_loading.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/run/stages/isotropic_unloading.hpp"
#include "solver/scenario/ranges.hpp"

namespace mpfem {

void IsotropicDrive::write(FieldWriter& to) const {
  WallLoading::write(to);
  to("loading.driven_speed", driven_.speed);
}

void IsotropicDrive::read(FieldReader& from) {
  WallLoading::read(from);
  from("loading.driven_speed", driven_.speed);
}

void IsotropicDrive::drive_to(const ObservedSample& seen, double leg_start, double target) {
  const double leg = target - leg_start, full_speed = seen.rate_factor * wall_speed_;
  double part = leg != 0 ? slowed_near_target((target - seen.mean_stress) / leg) : 0.0;
  if (leg < 0) part = std::max(part, slowest_unloading(target, leg_start));
  const double speed = driven_.approach(std::copysign(full_speed, leg) * part, full_speed, ramp_, seen.step);
  for (std::size_t axis = 0; axis < 3; ++axis) state_.speed[axis] = speed * seen.length[axis] / longest_;
}

IsotropicLoadingControl::IsotropicLoadingControl(const IsotropicLoading& stage, const StageLabel& label,
                                                 const StageStart& start)
    : IsotropicDrive(label, start, {.mean_stress = stage.mean_stress}, stage.wall_speed) {
  // The density at which the stress is reached is not known; powders are pressed to this one by then.
  constexpr double pressed_density = 0.9;
  const double scale = std::min(1 - expected_isotropic_strain,
                                std::cbrt(start.sample.solid_volume / start.cell.volume() / pressed_density));
  expected_scale_.fill(scale);
  const double travel = 0.5 * longest_ * (1 - scale);
  expected_duration_ = travel / stage.wall_speed;
  ramp_ = ramp_time(stage.ramp_fraction, travel, stage.wall_speed);
}

void IsotropicLoadingControl::begin(const ObservedSample& seen) {
  if (seen.mean_stress >= *ends_.mean_stress)
    throw SimulationError(
        fmt::format("stage '{}': mean_stress: {:g} MPa is to be reached by compaction, but {:.4g} MPa "
                    "act when the stage begins",
                    name_, *ends_.mean_stress, seen.mean_stress));
}

void IsotropicLoadingControl::drive(const ObservedSample& seen) {
  drive_to(seen, state_.start_mean_stress, *ends_.mean_stress);
}

LoadingEnd IsotropicLoadingControl::find_end(const ObservedSample& seen) const {
  const double target = *ends_.mean_stress;
  return (target - state_.start_mean_stress) * (seen.mean_stress - target) >= 0 ? LoadingEnd::mean_stress
                                                                                : LoadingEnd::none;
}

void IsotropicLoadingControl::check_limits(const ObservedSample& seen) const {
  if (seen.relative_density > largest_relative_density)
    fail(seen, fmt::format("which is above the largest allowed, {:g}", largest_relative_density));
  check_time(seen);
}

StressCyclesControl::StressCyclesControl(const StressCycles& stage, const StageLabel& label, const StageStart& start)
    : IsotropicDrive(label, start, {}, stage.wall_speed), stage_(stage) {
  const double travel = 0.5 * longest_ * expected_isotropic_strain;
  expected_duration_ = 2 * static_cast<double>(stage.cycles) * travel / stage.wall_speed;
  ramp_ = ramp_time(stage.ramp_fraction, travel, stage.wall_speed);
}

std::string StressCyclesControl::describe() const {
  return fmt::format("all walls, {} cycles between two mean stresses", stage_.cycles);
}

void StressCyclesControl::write(FieldWriter& to) const {
  IsotropicDrive::write(to);
  for_each_field(cycles_, to);
}

void StressCyclesControl::read(FieldReader& from) {
  IsotropicDrive::read(from);
  for_each_field(cycles_, from);
}

void StressCyclesControl::drive(const ObservedSample& seen) {
  const double p = seen.mean_stress, low = stage_.lowest_mean_stress, high = stage_.highest_mean_stress;
  const double range = high - low;
  if (upwards() ? p >= high : p <= low + unloading_tolerance(low, range)) {
    ++cycles_.legs;
    cycles_.leg_start = p;
  }
  // If the stage before ended beyond the range, that is no overshoot of this stage.
  constexpr double well_within = 0.5;
  if (p < high - well_within * range && p > low) cycles_.inside = true;
  if (cycles_.inside) cycles_.overshoot = std::max({cycles_.overshoot, p - high, cycles_.legs >= 2 ? low - p : 0.0});
  drive_to(seen, cycles_.leg_start, target());
}

LoadingEnd StressCyclesControl::find_end(const ObservedSample& /*seen*/) const {
  return cycles_.legs >= 2 * stage_.cycles ? LoadingEnd::cycles : LoadingEnd::none;
}

double StressCyclesControl::find_fraction_done(const ObservedSample& seen) const {
  const double leg = fraction_of_way(cycles_.leg_start, seen.mean_stress, target());
  return (static_cast<double>(cycles_.legs) + leg) / (2 * static_cast<double>(stage_.cycles));
}

std::string StressCyclesControl::end_text() const {
  if (!ended()) return WallLoading::end_text();
  return fmt::format("{} cycle{}", stage_.cycles, stage_.cycles == 1 ? "" : "s");
}

} // namespace mpfem
