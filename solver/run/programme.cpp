#include "solver/run/programme.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

namespace {

/// Integral of the smooth step 3 s^2 - 2 s^3 from 0 to s.
double smooth_step_integral(double s) {
  return s * s * s - 0.5 * s * s * s * s;
}

double volume(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
}

} // namespace

double motion_fraction(double time, double ramp) {
  const double t = std::clamp(time, 0.0, 1.0);
  // Speed rises to its plateau over `ramp`, so that the plateau speed is 1/(1 - ramp) of the mean.
  double distance = 0;
  if (ramp <= 0) return t;
  if (t < ramp)
    distance = ramp * smooth_step_integral(t / ramp);
  else if (t <= 1 - ramp)
    distance = 0.5 * ramp + (t - ramp);
  else
    distance = (1 - ramp) - ramp * smooth_step_integral((1 - t) / ramp);
  return distance / (1 - ramp);
}

StageMotion::StageMotion(const Stage& stage, const std::array<double, 3>& low, const std::array<double, 3>& high,
                         double solid_volume)
    : low_(low), high_(high) {
  if (stage.hold) {
    duration_ = stage.hold->duration;
    return;
  }
  const IsotropicCompaction& compaction = *stage.isotropic_compaction;
  const double density = solid_volume / volume(low, high);
  // Nearer than this, the walls would move by rounding errors.
  if (!(compaction.relative_density > density * (1 + 1e-9)))
    throw InputError(fmt::format("stage '{}': key 'relative_density': found {}, allowed more than the density at its "
                                 "start, {:.4f}",
                                 stage.name, compaction.relative_density, density));
  end_scale_ = std::cbrt(density / compaction.relative_density);
  ramp_ = compaction.ramp_fraction;
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, high[axis] - low[axis]);
  duration_ = 0.5 * longest * (1.0 - end_scale_) / (compaction.wall_speed * (1.0 - ramp_));
}

void StageMotion::place(Walls& walls, double time) const {
  const double scale = duration_ > 0 ? 1.0 + (end_scale_ - 1.0) * motion_fraction(time / duration_, ramp_) : 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double centre = 0.5 * (low_[axis] + high_[axis]), half = 0.5 * scale * (high_[axis] - low_[axis]);
    walls.low[axis] = centre - half;
    walls.high[axis] = centre + half;
  }
}

void check_programme(const Scenario& scenario, std::int64_t first_stage, std::array<double, 3> low,
                     std::array<double, 3> high, const Model& model, double stable_step) {
  constexpr double largest_travel = 0.05; // of h a step; a penetration of that size in one step is an impact
  const double smallest_size = *std::min_element(model.element_size.begin(), model.element_size.end());
  for (auto s = static_cast<std::size_t>(first_stage); s < scenario.stages.size(); ++s) {
    const Stage& stage = scenario.stages[s];
    const StageMotion motion(stage, low, high, model.total_reference_volume());
    Walls walls;
    motion.place(walls, motion.duration());
    low = walls.low, high = walls.high;
    if (const double fastest = largest_travel * smallest_size / stable_step;
        stage.isotropic_compaction && stage.isotropic_compaction->wall_speed > fastest)
      throw InputError(fmt::format(
          "stage '{}': key 'wall_speed': found {:g} mm/s, allowed at most {:.4g} mm/s here ({} of an element in a "
          "stable step of {:.3g} s)",
          stage.name, stage.isotropic_compaction->wall_speed, fastest, largest_travel, stable_step));
  }
}

} // namespace mpfem
