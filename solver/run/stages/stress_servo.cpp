#include "solver/run/stages/stress_servo.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

namespace {

/// A held wall's admittance P over that of the packing's waves. At 1 it absorbs waves and lags behind a packing that
/// strains: stresses were off by 7.5 % at worst in triaxial tests at 2 m/s; at 8, with the mass below, by 0.5 %.
constexpr double servo_admittance = 8.0;
/// The free mass of a held wall over that of the packing behind it. On a packing of the assumed modulus the damping
/// ratio is servo_admittance sqrt(servo_mass / 2) = 1.3, on one a tenth as stiff 0.4.
constexpr double servo_mass = 0.05;
/// tau over the transit time, and over the time step: the servo does not respond to waves of single elements.
constexpr double servo_delay = 0.02, servo_delay_steps = 20;

} // namespace

double HoldQuality::root_mean_square() const {
  return time > 0 ? std::sqrt(square / time) : 0.0;
}

StressServo::StressServo(const StageStart& start, double largest_speed)
    : largest_speed_(largest_speed), transit_(wave_transit(start.sample, start.cell)),
      contact_stiffness_(start.sample.contact_stiffness) {
  const double density = start.sample.mass / start.cell.volume();
  const double modulus = compact_modulus * start.sample.constrained_modulus;
  gain_ = servo_admittance / std::sqrt(density * modulus);
  slow_gain_ = 1.0 / (servo_mass * density * start.cell.longest());
}

double StressServo::hold(ServoState& s, HoldQuality& quality, double wanted, double stress, double step,
                         double rate_factor) const {
  const double error = wanted - stress, limit = largest_speed_ * std::max(1.0, rate_factor);
  // Both masses of the wall, tau/P and 1/I, must be such that steps resolve them on the spring of a wall in full
  // contact, whose nodes at edges count twice: explicit steps are stable up to spring dt^2/mass = 4, and at these
  // bounds the sum is 3.
  const double spring = contact_stiffness_ * step * step;
  const double delay = std::max({servo_delay * transit_, servo_delay_steps * step, gain_ * spring});
  const double slow_gain = spring > 0 ? std::min(slow_gain_, 0.5 / spring) : slow_gain_;
  s.fast += (gain_ * error - s.fast) * step / (delay + step);
  // At its limit the wall cannot do more; what it has missed must not be made up for later.
  const double before = s.fast + s.slow;
  if (std::abs(before) < limit || before * error < 0)
    s.slow = std::clamp(s.slow + slow_gain * error * step, -limit, limit);
  s.error += (error - s.error) * step / (transit_ + step);
  quality.largest_error = std::max(quality.largest_error, std::abs(s.error));
  quality.square += error * error * step;
  quality.time += step;
  quality.largest_stress = std::max(quality.largest_stress, std::abs(wanted));
  return std::clamp(s.fast + s.slow, -limit, limit);
}

} // namespace mpfem
