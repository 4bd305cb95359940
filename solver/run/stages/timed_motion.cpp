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

void TimedBox::place(Walls& walls, double time) const {
  const double done = fraction(time);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double scale = 1.0 + (end_scale[axis] - 1.0) * done;
    const double centre = 0.5 * (low[axis] + high[axis]), half = 0.5 * scale * (high[axis] - low[axis]);
    walls.low[axis] = centre - half;
    walls.high[axis] = centre + half;
  }
}

} // namespace mpfem
