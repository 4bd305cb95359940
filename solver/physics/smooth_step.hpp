#pragma once
// A ramp from 0 to 1 that begins and ends with slope 0.

#include <algorithm>

namespace mpfem {

/// s^2 (3 - 2 s), for s clamped to [0, 1].
inline double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

} // namespace mpfem
