#include "solver/run/stages/held_stress.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/physics/smooth_step.hpp"

namespace mpfem {

double ramped(double time, double ramp, double start, double given) {
  return start + (given - start) * (ramp > 0 ? smooth_step(time / ramp) : 1.0);
}

StageResult with_hold_quality(StageResult result, const HoldQuality& quality) {
  result.hold_error = quality.largest_error;
  result.hold_stress = quality.largest_stress;
  result.hold_root_mean_square = quality.root_mean_square();
  return result;
}

StageResult HeldWalls::result(const StageObservation& last) const {
  return with_hold_quality(WallLoading::result(last), quality_);
}

void HeldWalls::write(FieldWriter& to) const {
  WallLoading::write(to);
  for (const ServoState& servo : axes_) ServoState::for_each_field(servo, to);
  HoldQuality::for_each_field(quality_, to);
}

void HeldWalls::read(FieldReader& from) {
  WallLoading::read(from);
  for (ServoState& servo : axes_) ServoState::for_each_field(servo, from);
  HoldQuality::for_each_field(quality_, from);
}

HeldStressControl::HeldStressControl(const HeldStress& stage, const StageLabel& label, const StageStart& start)
    : HeldWalls(label, start, {.duration = stage.duration}, stage.servo_speed), mean_stress_(stage.mean_stress) {
  expected_duration_ = stage.duration;
  ramp_ = 0.5 * stage.duration;
}

std::string HeldStressControl::describe() const {
  return fmt::format("all walls held at {:g} MPa for {:g} s", mean_stress_, expected_duration_);
}

void HeldStressControl::drive(const ObservedSample& seen) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    hold(seen, axis, ramped(seen.time, ramp_, state_.start_stress[axis], mean_stress_));
}

/// A hold must arrive at its stress.
void HeldStressControl::check_end(const ObservedSample& seen) const {
  constexpr double tolerance = 0.1; // of the stress
  // The running mean over a transit started at zero.
  const double weight = 1 - std::exp(-seen.time / wave_transit(start_.sample, start_.cell));
  double missed = 0;
  for (const ServoState& axis : axes_)
    if (std::abs(axis.error) > std::abs(missed)) missed = axis.error;
  missed /= weight;
  if (std::abs(missed) <= tolerance * mean_stress_) return;
  throw SimulationError(
      fmt::format("stage '{}': a stress is {:.3g} MPa {} the {:g} MPa to be held at its end ({:.0f} %), allowed: {:g} "
                  "%; give it a longer duration or a larger servo_speed",
                  name_, std::abs(missed), missed > 0 ? "below" : "above", mean_stress_,
                  100 * std::abs(missed) / mean_stress_, 100 * tolerance));
}

StressProbeControl::StressProbeControl(const StressProbe& stage, const StageLabel& label, const StageStart& start)
    : HeldWalls(label, start, stage.ends, stage.servo_speed), stage_(stage) {
  const auto [dp, dq] = stage.direction;
  path_stress_ = {dp - dq / 3, dp - dq / 3, dp + 2 * dq / 3};
  const double leading = std::max(std::abs(path_stress_[0]), std::abs(path_stress_[2]));
  for (double& stress : path_stress_) stress /= leading;
  const double edge = start.cell.longest(), modulus = compact_modulus * start.sample.constrained_modulus;
  const double travel = 0.5 * edge * expected_isotropic_strain;
  expected_duration_ = travel / stage.wall_speed;
  start_rate_ = 0.1 * stage.wall_speed * 2 * modulus / edge;
  ramp_ = ramp_time(stage.ramp_fraction, travel, stage.wall_speed);
  if (ends_.duration) expected_duration_ = std::min(expected_duration_, *ends_.duration);
}

void StressProbeControl::write(FieldWriter& to) const {
  HeldWalls::write(to);
  for_each_field(path_, to);
}

void StressProbeControl::read(FieldReader& from) {
  HeldWalls::read(from);
  for_each_field(path_, from);
}

void StressProbeControl::begin(const ObservedSample& /*seen*/) {
  path_.rate = start_rate_;
}

void StressProbeControl::drive(const ObservedSample& seen) {
  /// The path slows down when stresses are off it by more than this fraction of the largest.
  constexpr double path_tolerance = 0.005;
  /// The slowest rate of the path over its initial rate.
  constexpr double slowest_path = 0.2;
  path_.change += path_.rate * seen.step;
  double fastest = 0, off = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hold(seen, axis, state_.start_stress[axis] + path_.change * path_stress_[axis]);
    fastest = std::max(fastest, std::abs(axes_[axis].slow));
    off = std::max(off, std::abs(axes_[axis].error));
  }
  // As fast as the walls may go, and as the stresses follow.
  const double full_speed = seen.rate_factor * stage_.wall_speed;
  const double load = std::max(fastest / full_speed, off / (path_tolerance * quality_.largest_stress));
  if (ramp_ > 0) path_.rate *= std::exp(std::clamp(1 - load, -5.0, 1.0) * seen.step / ramp_);
  // Vibration must not bring it to a halt.
  path_.rate = std::max(path_.rate, slowest_path * start_rate_);
}

LoadingEnd StressProbeControl::find_end(const ObservedSample& seen) const {
  const auto [dp, dq] = stage_.direction;
  if (ends_.axial_strain && std::abs(seen.strain[2]) >= std::abs(*ends_.axial_strain)) return LoadingEnd::axial_strain;
  if (ends_.mean_stress && dp * (seen.mean_stress - *ends_.mean_stress) >= 0) return LoadingEnd::mean_stress;
  if (ends_.deviatoric_stress && (dq < 0 ? -1.0 : 1.0) * (seen.deviatoric_stress - *ends_.deviatoric_stress) >= 0)
    return LoadingEnd::deviatoric_stress;
  return common_end(seen);
}

void StressProbeControl::check_limits(const ObservedSample& seen) const {
  HeldWalls::check_limits(seen);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (path_stress_[axis] < 0 && state_.start_stress[axis] + path_.change * path_stress_[axis] < 0)
      fail(seen, fmt::format("but the path requires the walls along {} to pull", "xyz"[axis]));
}

} // namespace mpfem
