#include "solver/run/stages/timed_motion.hpp"

#include <algorithm>

#include "solver/physics/smooth_step.hpp"

namespace mpfem {

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

Cell TimedCell::at(double time) const {
  const double done = fraction(time);
  Cell cell = start;
  for (std::size_t axis = 0; axis < 3; ++axis) cell.stretch(axis, 1.0 + (end_scale[axis] - 1.0) * done);
  return cell;
}

} // namespace mpfem
