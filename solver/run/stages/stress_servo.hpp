#pragma once
// The law of a wall that is held at a stress.
//
// With e = wanted - measured stress of an axis (mean of its two walls), both walls move inwards at
//   u = f + s,   tau df/dt = P e - f,   ds/dt = I e,
// bounded by the servo speed. From force to velocity this is two masses side by side, one (1/I an area) free, the other
// (tau/P) behind a dashpot: a passive machine. It cannot make another passive system, such as a packing, oscillate,
// however stiff or soft that is and however long its waves take, so no stiffness has to be known. P, I and tau only
// decide how fast and how well damped the walls follow. They are set by the packing's own impedance (P: a wall that is
// much easier to move than the packing), mass (I) and transit time (tau); see docs/numerics.md.

#include <array>

#include "solver/run/stages/observed_sample.hpp"

namespace mpfem {

/// The servo of one axis.
struct ServoState {
  double fast = 0, slow = 0; ///< mm/s, the two parts f and s of the speed
  double error = 0;          ///< MPa, wanted less measured stress, averaged over a transit
  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("servo.fast", s.fast), visit("servo.slow", s.slow), visit("servo.error", s.error);
  }
};

/// How well stresses were held, over all axes.
struct HoldQuality {
  double largest_error = 0;  ///< MPa, largest magnitude of a servo's error so far
  double largest_stress = 0; ///< MPa, largest wanted stress so far
  double square = 0;         ///< MPa^2 s, integral of the square of wanted less measured stress
  double time = 0;           ///< s, integral of 1, likewise
  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("hold.largest_error", s.largest_error), visit("hold.largest_stress", s.largest_stress);
    visit("hold.square", s.square), visit("hold.time", s.time);
  }
  double root_mean_square() const; ///< MPa
};

/// The gains of that law, from the packing when a stage begins.
class StressServo {
public:
  /// `largest_speed` in mm/s.
  StressServo(const StageStart& start, double largest_speed);
  /// mm/s inwards of both walls of an axis, or of a tool along its direction, that is to be held at `wanted` and has
  /// `stress` (MPa). `step` in s; `rate_factor`: current speed over the stage's own.
  double hold(ServoState& state, HoldQuality& quality, double wanted, double stress, double step,
              double rate_factor) const;

private:
  double largest_speed_;
  double transit_;           ///< s, of waves through a soft compact
  double gain_;              ///< P, mm/s per MPa
  double slow_gain_;         ///< I, mm/s^2 per MPa
  double contact_stiffness_; ///< MPa/mm
};

} // namespace mpfem
