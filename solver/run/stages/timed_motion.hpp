#pragma once
// Motions whose whole course is known beforehand: constant speed between a smooth start and a smooth end.

#include <array>

#include "solver/boundary/cell.hpp"

namespace mpfem {

/// Fraction of a motion that is done at the fraction `time` of its duration: constant speed between a smooth start and
/// a smooth end, each lasting `ramp` of the duration (speed follows 3 s^2 - 2 s^3), in [0, 1].
double motion_fraction(double time, double ramp);

/// A cell that grows or shrinks about its centre.
struct TimedCell {
  Cell start;
  std::array<double, 3> end_scale{1, 1, 1}; ///< lengths at the end over those at the start
  double duration = 0;                      ///< s
  double ramp = 0;                          ///< of the duration

  /// The cell at a time (s) since the start.
  Cell at(double time) const;
  /// Part of the motion that is done, in [0, 1].
  double fraction(double time) const { return duration > 0 ? motion_fraction(time / duration, ramp) : 0.0; }
};

} // namespace mpfem
