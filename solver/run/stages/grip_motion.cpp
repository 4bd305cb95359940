#include "solver/run/stages/grip_motion.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

GripMotionControl::GripMotionControl(const GripMotion& stage, const StageLabel& label, const StageStart& start)
    : TimedStage(start), stage_(stage) {
  const double length = start.cell.length(stage.axis);
  motion_.end_scale[stage.axis] = 1.0 + stage.displacement / length;
  if (!(motion_.end_scale[stage.axis] > 0))
    throw InputError(fmt::format("{}stage '{}': key 'displacement': found {:g} mm, allowed: > {:g} mm, the distance "
                                 "of the grips",
                                 label.places.prefix("displacement"), label.name, stage.displacement, -length));
  if (!(2 * stage.depth < length))
    throw InputError(fmt::format("{}stage '{}': key 'grip_depth': found {:g} mm, allowed: < {:g} mm, half the "
                                 "distance of the grips",
                                 label.places.prefix("grip_depth"), label.name, stage.depth, 0.5 * length));
  motion_.ramp = stage.ramp_fraction;
  const auto& s = stage.sliding;
  const double travel = std::hypot(stage.displacement, std::hypot(s[0], s[1], s[2]));
  motion_.duration = 0.5 * travel / (stage.speed * (1.0 - motion_.ramp));
}

std::array<double, 3> GripMotionControl::sliding(double time) const {
  std::array<double, 3> result = stage_.sliding;
  for (double& component : result) component *= motion_fraction(time / motion_.duration, motion_.ramp);
  return result;
}

StageResult GripMotionControl::result(const StageObservation& /*last*/) const {
  return {.ended_by = fmt::format("displacement {:g} mm", stage_.displacement)};
}

} // namespace mpfem
