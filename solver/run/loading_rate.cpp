#include "solver/run/loading_rate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpfem {

namespace {

/// Fraction of the tolerances to aim at: observations scatter about their mean.
constexpr double aim = 0.7;
/// Transits in which the rate changes by a factor of e when the load is off its aim by 1.
constexpr double transits_to_respond = 1;
/// Bounds on the load's distance from its aim: walls brake within a transit, and gather speed more gently.
constexpr double hardest_braking = 2, strongest_acceleration = 0.5;

} // namespace

LoadingRateControl::LoadingRateControl(const QuasiStatic& tolerances, double wall_speed, double transit)
    : tolerances_(tolerances), wall_speed_(wall_speed), transit_(transit) {}

void LoadingRateControl::update(LoadingRateState& s, const LoadingRateObservation& seen) const {
  double wall_stress = 0, stress = 0;
  const double weight = seen.elapsed / (transit_ + seen.elapsed);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    wall_stress = std::max(wall_stress, std::abs(seen.wall_stress[axis])); // grips may pull
    s.imbalance[axis] += (seen.imbalance[axis] - s.imbalance[axis]) * weight;
    s.dynamic[axis] += (seen.dynamic[axis] - s.dynamic[axis]) * weight;
    stress = std::max({stress, std::abs(s.imbalance[axis]), std::abs(s.dynamic[axis])});
  }
  const double response = seen.elapsed / (transits_to_respond * transit_);
  const double braked = std::max(1.0, s.factor * std::exp(-hardest_braking * response));
  if (!(wall_stress > tolerances_.loose_stress)) { // nothing to judge by
    if (seen.stopping) s.factor = std::min(s.factor, braked);
    return;
  }
  stress /= wall_stress;
  const double internal = seen.elastic_energy + seen.plastic_dissipation - s.dissipation_at_start;
  // In the form v- v+ it may be slightly negative when the motion rings.
  const double kinetic_energy = std::max(seen.kinetic_energy, 0.0);
  const double kinetic = kinetic_energy > 0 ? kinetic_energy / std::max(internal, 1e-3 * kinetic_energy) : 0.0;
  s.largest_kinetic = std::max(s.largest_kinetic, kinetic);
  s.largest_stress = std::max(s.largest_stress, stress);
  s.time_loaded += seen.elapsed;
  const double load =
      std::max(std::sqrt(kinetic / tolerances_.kinetic_tolerance), stress / tolerances_.stress_tolerance);
  if (load > 1) s.time_beyond += seen.elapsed;
  const double rate = std::clamp(aim - load, -hardest_braking, strongest_acceleration);
  const double wanted = s.factor * std::exp(rate * response);
  const double most = seen.stopping ? braked : tolerances_.fastest_speed / wall_speed_;
  s.factor = std::clamp(wanted, tolerances_.slowest_speed / wall_speed_, most);
  if (wanted < s.factor && load > 1) s.at_slowest = true;
  s.slowest = std::min(s.slowest, s.factor);
  s.fastest = std::max(s.fastest, s.factor);
}

std::string LoadingRateControl::text(const LoadingRateState& s) const {
  return fmt::format(
      "wall speed chosen between {:.4g} and {:.4g} mm/s; under load, kinetic over internal energy was at most {:.3g} "
      "%, inertia carried at most {:.3g} % of the stress, and the tolerances were exceeded for {:.3g} % of the time",
      s.slowest * wall_speed_, s.fastest * wall_speed_, 100 * s.largest_kinetic, 100 * s.largest_stress,
      s.time_loaded > 0 ? 100 * s.time_beyond / s.time_loaded : 0.0);
}

} // namespace mpfem
