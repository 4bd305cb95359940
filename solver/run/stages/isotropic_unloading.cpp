#include "solver/run/stages/isotropic_unloading.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/run/stages/driven_speed.hpp"

namespace mpfem {

double slowest_unloading(double target, double start) {
  constexpr double stiff = 0.1, soft_part = 0.25; // of the stress at the start, of the wall speed
  return target > stiff * start ? slowest_approach : soft_part;
}

double unloading_tolerance(double target, double change) {
  constexpr double of_change = 1e-3, of_target = 0.01;
  return target > 0 ? std::min(of_change * change, of_target * target) : of_change * change;
}

IsotropicUnloadingControl::IsotropicUnloadingControl(const IsotropicUnloading& stage, const StageLabel& label,
                                                     const StageStart& start)
    : stage_(stage), name_(label.name), start_cell_(start.cell), start_stress_(start.mean_stress),
      expected_duration_(0.5 * start.cell.longest() * expected_isotropic_strain / stage.wall_speed),
      mean_stress_(start.mean_stress),
      // If there is nothing to unload, the walls do not move, and a stress that rises a little would never come down to
      // its target.
      ended_(!(start.mean_stress > stage.mean_stress)) {}

void IsotropicUnloadingControl::observe(const StageObservation& seen) {
  constexpr double largest_growth = 0.3;
  mean_stress_ = seen.mean_stress;
  const double change = start_stress_ - stage_.mean_stress;
  ended_ = !(change > 0) || seen.mean_stress <= stage_.mean_stress + unloading_tolerance(stage_.mean_stress, change);
  if (!ended_ && seen.cell.length(0) > (1 + largest_growth) * start_cell_.length(0))
    throw SimulationError(
        fmt::format("stage '{}': the mean stress is still {:.3g} MPa, target {:g} MPa, after the cell "
                    "grew by {:.0f} % in length",
                    name_, seen.mean_stress, stage_.mean_stress, 100 * largest_growth));
}

double IsotropicUnloadingControl::speed(double time) const {
  const double change = start_stress_ - stage_.mean_stress;
  if (!(change > 0)) return 0; // nothing to unload
  const double ramp = stage_.ramp_fraction * expected_duration_;
  const double s = ramp > 0 ? std::min(time / ramp, 1.0) : 1.0;
  // The walls slow down near the end, so that the packing is then nearly at rest.
  const double left = (mean_stress_ - stage_.mean_stress) / change;
  return stage_.wall_speed * (3 - 2 * s) * s * s *
         slowed_near_target(left, slowest_unloading(stage_.mean_stress, start_stress_));
}

void IsotropicUnloadingControl::move(Cell& cell, double time, double clock_step, double /*step*/) const {
  const double strain = speed(time) * clock_step / start_cell_.longest(); // of half of the cell
  for (std::size_t axis = 0; axis < 3; ++axis) cell.move_inwards(axis, -(strain * start_cell_.length(axis)));
}

double IsotropicUnloadingControl::fraction_done(double /*time*/, double mean_stress) const {
  const double change = start_stress_ - stage_.mean_stress;
  return change > 0 ? std::clamp((start_stress_ - mean_stress) / change, 0.0, 1.0) : 1.0;
}

StageResult IsotropicUnloadingControl::result(const StageObservation& last) const {
  return {.ended_by = fmt::format("mean stress {:g} MPa", stage_.mean_stress),
          .overshoot = std::max(stage_.mean_stress - last.mean_stress, 0.0)};
}

} // namespace mpfem
