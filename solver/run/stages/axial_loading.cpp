#include "solver/run/stages/axial_loading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/run/stages/held_stress.hpp"

namespace mpfem {

AxialLoading::AxialLoading(const AxialDrive& stage, const StageLabel& label, const StageStart& start)
    : WallLoading(label, start, stage.ends), wall_speed_(stage.wall_speed),
      transit_(wave_transit(start.sample, start.cell)) {
  double scale = 1 - expected_strain;
  if (ends_.axial_strain)
    scale = std::exp(-*ends_.axial_strain);
  else if (ends_.relative_density)
    scale = start.sample.solid_volume / start.cell.volume() / *ends_.relative_density;
  const double travel = 0.5 * start_length_[2] * std::abs(1 - scale);
  if (ends_.axial_strain || ends_.relative_density) expected_scale_[2] = scale;
  // A fraction of the travel is done at half of the speed, at both ends.
  expected_duration_ = travel / stage.wall_speed * (1 + 1.5 * stage.ramp_fraction);
  ramp_ = ramp_time(stage.ramp_fraction, travel, stage.wall_speed);
  if (ends_.duration) expected_duration_ = std::min(expected_duration_, *ends_.duration);
}

void AxialLoading::write(FieldWriter& to) const {
  WallLoading::write(to);
  to("loading.driven_speed", driven_.speed);
  for_each_field(axial_, to);
}

void AxialLoading::read(FieldReader& from) {
  WallLoading::read(from);
  from("loading.driven_speed", driven_.speed);
  for_each_field(axial_, from);
}

void AxialLoading::begin(const ObservedSample& seen) {
  const double change = ends_.axial_strain        ? *ends_.axial_strain
                        : ends_.relative_density  ? *ends_.relative_density - seen.relative_density
                        : ends_.axial_stress      ? *ends_.axial_stress - seen.stress[2]
                        : ends_.deviatoric_stress ? *ends_.deviatoric_stress - seen.deviatoric_stress
                                                  : 1.0;
  axial_.sign = change < 0 ? -1.0 : 1.0;
}

void AxialLoading::drive(const ObservedSample& seen) {
  const double full_speed = seen.rate_factor * wall_speed_;
  double part = 1;
  // A travel that is known ends at rest, by constant deceleration.
  double left = std::numeric_limits<double>::infinity(); // mm, of each wall's travel
  const auto stop_at = [&](double length) {
    left = std::min(left, std::max(0.5 * axial_.sign * (seen.length[2] - length), 0.0));
    part = std::min(part, slowed_to_rest(left, full_speed, ramp_));
  };
  if (ends_.axial_strain) stop_at(start_length_[2] * std::exp(-*ends_.axial_strain));
  if (ends_.relative_density) stop_at(start_.sample.solid_volume / (seen.area[2] * *ends_.relative_density));
  const auto slow_near = [&](const std::optional<double>& target, double start, double stress) {
    if (target && *target != start) part = std::min(part, slowed_near_target((*target - stress) / (*target - start)));
  };
  const auto& start = state_.start_stress;
  slow_near(ends_.axial_stress, start[2], seen.stress[2]);
  slow_near(ends_.deviatoric_stress, start[2] - 0.5 * (start[0] + start[1]), seen.deviatoric_stress);
  // The last step goes to the target and not past it.
  const double most = seen.step > 0 ? left / seen.step : left;
  const double speed = driven_.approach(axial_.sign * full_speed * part, full_speed, ramp_, seen.step);
  state_.speed[2] = std::clamp(speed, -most, most);
  watch_peak(seen);
}

void AxialLoading::watch_peak(const ObservedSample& seen) {
  if (!ends_.stress_drop) return;
  axial_.watched += (watched_stress(seen) - axial_.watched) * seen.step / (transit_ + seen.step);
  // While the walls start, the sample settles: no peak yet.
  if (seen.time > ramp_) axial_.peak = std::max(axial_.peak, axial_.watched);
}

LoadingEnd AxialLoading::find_end(const ObservedSample& seen) const {
  const double sign = axial_.sign;
  if (ends_.axial_strain && sign * (seen.strain[2] - *ends_.axial_strain) >= -arrived) return LoadingEnd::axial_strain;
  if (ends_.relative_density && sign * (seen.relative_density - *ends_.relative_density) >= -arrived)
    return LoadingEnd::relative_density;
  if (ends_.axial_stress && sign * (seen.stress[2] - *ends_.axial_stress) >= 0) return LoadingEnd::axial_stress;
  if (ends_.deviatoric_stress && sign * (seen.deviatoric_stress - *ends_.deviatoric_stress) >= 0)
    return LoadingEnd::deviatoric_stress;
  if (ends_.stress_drop && axial_.peak > 0 && axial_.watched <= (1 - *ends_.stress_drop) * axial_.peak)
    return LoadingEnd::stress_drop;
  return common_end(seen);
}

std::string AxialLoading::end_text() const {
  if (state_.ended_by != LoadingEnd::stress_drop) return WallLoading::end_text();
  return fmt::format("stress drop of {:g} from a peak of {:.4g} MPa", *ends_.stress_drop, axial_.peak);
}

TriaxialCompressionControl::TriaxialCompressionControl(const TriaxialCompression& stage, const StageLabel& label,
                                                       const StageStart& start)
    : AxialLoading(stage, label, start), stage_(stage), servo_(start, stage.servo_speed) {}

std::string TriaxialCompressionControl::describe() const {
  return fmt::format("z walls driven, x and y walls held at constant {}", stage_.hold_force ? "force" : "stress");
}

double TriaxialCompressionControl::wanted_stress(const ObservedSample& seen, std::size_t axis) const {
  const double start_area = start_length_[1 - axis] * start_length_[2];
  const double given = stage_.lateral_stress.value_or(state_.start_stress[axis]);
  return stage_.hold_force ? ramped(seen.time, ramp_, state_.start_force[axis], given * start_area) / seen.area[axis]
                           : ramped(seen.time, ramp_, state_.start_stress[axis], given);
}

void TriaxialCompressionControl::drive(const ObservedSample& seen) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    state_.speed[axis] = servo_.hold(lateral_[axis], quality_, wanted_stress(seen, axis), seen.stress[axis], seen.step,
                                     seen.rate_factor);
  AxialLoading::drive(seen);
}

StageResult TriaxialCompressionControl::result(const StageObservation& last) const {
  return with_hold_quality(AxialLoading::result(last), quality_);
}

void TriaxialCompressionControl::write(FieldWriter& to) const {
  AxialLoading::write(to);
  for (const ServoState& servo : lateral_) ServoState::for_each_field(servo, to);
  HoldQuality::for_each_field(quality_, to);
}

void TriaxialCompressionControl::read(FieldReader& from) {
  AxialLoading::read(from);
  for (ServoState& servo : lateral_) ServoState::for_each_field(servo, from);
  HoldQuality::for_each_field(quality_, from);
}

} // namespace mpfem
