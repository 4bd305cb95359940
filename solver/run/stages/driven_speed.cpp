#include "solver/run/stages/driven_speed.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

double DrivenSpeed::approach(double wanted, double full_speed, double ramp, double step) {
  const double change = ramp > 0 ? full_speed * step / ramp : 2 * full_speed;
  speed += std::clamp(wanted - speed, -change, change);
  return speed;
}

double slowed_near_target(double left, double slowest) {
  return std::clamp(5 * left, slowest, 1.0);
}

double slowed_to_rest(double left, double full_speed, double ramp) {
  const double stopping = 0.5 * full_speed * ramp; // mm, from full speed
  return stopping > 0 ? std::clamp(std::sqrt(left / stopping), slowest_approach, 1.0) : 1.0;
}

double fraction_of_way(double start, double now, double end) {
  return end != start ? std::clamp((now - start) / (end - start), 0.0, 1.0) : 1.0;
}

} // namespace mpfem
