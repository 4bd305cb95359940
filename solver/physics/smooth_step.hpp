#pragma once
// A ramp from 0 to 1 that begins and ends with slope 0.

#include <algorithm>

namespace mpfem {

/// s^2 (3 - 2 s), for s clamped to [0, 1].
inline double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// Integral of smooth_step from 0 to s, for s in [0, 1].
inline double smooth_step_integral(double s) {
  return s * s * s - 0.5 * s * s * s * s;
}

} // namespace mpfem
