#pragma once
// Motions whose whole course is known beforehand: constant speed between a smooth start and a smooth end.

#include <array>

#include "solver/boundary/grips.hpp"
#include "solver/boundary/walls.hpp"
#include "solver/kernels/node_motion.hpp"

namespace mpfem {

/// Fraction of a motion that is done at the fraction `time` of its duration: constant speed between a smooth start and a
/// smooth end, each lasting `ramp` of the duration (speed follows 3 s^2 - 2 s^3), in [0, 1].
double motion_fraction(double time, double ramp);

/// A box that grows or shrinks about its centre.
struct TimedBox {
  std::array<double, 3> low{}, high{};      ///< mm, at the start
  std::array<double, 3> end_scale{1, 1, 1}; ///< lengths at the end over those at the start
  double duration = 0;                      ///< s
  double ramp = 0;                          ///< of the duration

  /// Puts the walls where they stand at a time (s) since the start.
  void place(Walls& walls, double time) const;
  /// Part of the motion that is done, in [0, 1].
  double fraction(double time) const { return duration > 0 ? motion_fraction(time / duration, ramp) : 0.0; }
};

} // namespace mpfem
