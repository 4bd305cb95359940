#pragma once
// The velocity update of central differences with mass-proportional damping.
//
// Damping acts on the motion relative to the affine velocity field that the walls impose, so that it does not resist
// compaction itself. With the rate c (1/s) and that field's velocity t at the centre of a node's grain,
//   m dv/dt = f - c m (v - t).
// With dt the mean of the two steps around the time of the forces, and the mean of v- and v+ in the damping term,
//   v+ = (1 - b)/(1 + b) v- + dt/(1 + b) f/m + 2 b/(1 + b) t,   b = c dt / 2.

#include <array>
#include <cstddef>

namespace mpfem {

/// What the velocity update needs besides the forces.
struct Advance {
  double step_mean = 0;    ///< s, from the half step before now to the one after
  double step = 0;         ///< s, for the update of positions
  double damping_rate = 0; ///< c, 1/s
  // The affine velocity field of the walls.
  std::array<double, 3> centre{};   ///< mm
  std::array<double, 3> velocity{}; ///< mm/s, at the centre
  std::array<double, 3> rate{};     ///< 1/s, of stretching along each axis
};

/// Coefficients of the damped update v+ = keep v- + gain f/m + pull t.
struct DampedUpdate {
  double keep;
  double gain; ///< s
  double pull;

  /// v+ in mm/s from v- (mm/s), the force over the mass (mm/s^2) and t (mm/s).
  double velocity(double before, double inverse_mass, double force, double target) const {
    return keep * before + gain * inverse_mass * force + pull * target;
  }
  /// The force (N) with which `velocity` gives `after`.
  double force(double before, double after, double inverse_mass, double target) const {
    return (after - keep * before - pull * target) / (gain * inverse_mass);
  }
};

/// The coefficients; without damping they are 1, dt, 0.
inline DampedUpdate damped_update(const Advance& p) {
  const double beta = 0.5 * p.damping_rate * p.step_mean;
  return {(1.0 - beta) / (1.0 + beta), p.step_mean / (1.0 + beta), 2.0 * beta / (1.0 + beta)};
}

/// Component `axis` of the affine velocity field (mm/s) at `coordinate` (mm).
inline double affine_velocity(const Advance& p, std::size_t axis, double coordinate) {
  return p.velocity[axis] + p.rate[axis] * (coordinate - p.centre[axis]);
}

} // namespace mpfem
