#include "solver/run/pace.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpfem {

namespace {

/// Part of the tolerances that is aimed at: what is seen scatters around its mean.
constexpr double aim = 0.7;
/// Transits in which the pace changes by a factor of e where the load is off its aim by one.
constexpr double transits_to_respond = 2;
/// Bounds on the load's distance from its aim: walls brake within a transit, and gather speed more gently.
constexpr double hardest_braking = 2, strongest_acceleration = 0.5;

} // namespace

PaceControl::PaceControl(const QuasiStatic& tolerances, double wall_speed, double transit)
    : tolerances_(tolerances), wall_speed_(wall_speed), transit_(transit) {}

void PaceControl::update(PaceState& s, const PaceObservation& seen) const {
  double largest_stress = 0, imbalance = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = seen.wall_stress[2 * axis], high = seen.wall_stress[2 * axis + 1];
    largest_stress = std::max(largest_stress, 0.5 * (low + high));
    s.imbalance[axis] += (high - low - s.imbalance[axis]) * seen.elapsed / (transit_ + seen.elapsed);
    imbalance = std::max(imbalance, std::abs(s.imbalance[axis]));
  }
  if (!(largest_stress > tolerances_.loose_stress)) return;
  imbalance /= largest_stress;
  const double internal = seen.elastic_energy + seen.plastic_dissipation - s.dissipation_at_start;
  const double kinetic = seen.kinetic_energy / std::max(internal, 1e-3 * seen.kinetic_energy);
  s.largest_kinetic = std::max(s.largest_kinetic, kinetic);
  s.largest_imbalance = std::max(s.largest_imbalance, imbalance);
  s.time_loaded += seen.elapsed;
  const double load =
      std::max(std::sqrt(kinetic / tolerances_.kinetic_tolerance), imbalance / tolerances_.imbalance_tolerance);
  if (load > 1) s.time_beyond += seen.elapsed;
  const double rate = std::clamp(aim - load, -hardest_braking, strongest_acceleration);
  const double wanted = s.pace * std::exp(rate * seen.elapsed / (transits_to_respond * transit_));
  s.pace = std::clamp(wanted, tolerances_.slowest_speed / wall_speed_, tolerances_.fastest_speed / wall_speed_);
  if (wanted < s.pace && load > 1) s.at_slowest = 1;
  s.slowest = std::min(s.slowest, s.pace);
  s.fastest = std::max(s.fastest, s.pace);
}

std::string PaceControl::text(const PaceState& s) const {
  return fmt::format("wall speed chosen between {:.4g} and {:.4g} mm/s; under load kinetic/internal at most {:.2g} %, "
                     "opposite walls within {:.2g} %, beyond the tolerances for {:.2g} % of the time",
                     s.slowest * wall_speed_, s.fastest * wall_speed_, 100 * s.largest_kinetic,
                     100 * s.largest_imbalance, s.time_loaded > 0 ? 100 * s.time_beyond / s.time_loaded : 0.0);
}

} // namespace mpfem
