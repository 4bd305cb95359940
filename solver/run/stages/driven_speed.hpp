#pragma once
// Loadings by walls or tools: how their speed rises and falls towards a target, and when they have arrived.

namespace mpfem {

/// Fraction of the full speed at which a target is reached.
inline constexpr double slowest_approach = 0.05;
/// Strain along z after which a loading is expected to end if its ends do not determine it.
inline constexpr double expected_strain = 0.05;
/// Strain, travel and density count as reached when they are this near: walls and tools arrive up to rounding.
inline constexpr double arrived = 1e-9;
/// No loading may last longer than this many times the expected time.
inline constexpr double longest_time = 50;
/// Steps that a loading is expected to take at least: also a target nearer than a step's travel takes some, because the
/// stage begins at rest.
inline constexpr double fewest_steps = 20;

/// A speed that changes no faster than a ramp allows.
struct DrivenSpeed {
  double speed = 0; ///< mm/s inwards, or the part of a full speed
  /// A step (s) later: nearer to the wanted speed, as far as a ramp of `ramp` s to the full speed allows.
  double approach(double wanted, double full_speed, double ramp, double step);
};

/// Part of the full speed while a fraction `left` of a change of stress or force remains: the last fifth takes ever
/// longer, but the part is at least `slowest`.
double slowed_near_target(double left, double slowest = slowest_approach);

/// Part of the full speed (mm/s) that, by constant deceleration over the time `ramp` (s), brings a travel of which
/// `left` mm remain to rest.
double slowed_to_rest(double left, double full_speed, double ramp);

/// The part done, in [0, 1], of the way from `start` to `end`; 1 if there is none.
double fraction_of_way(double start, double now, double end);

} // namespace mpfem
