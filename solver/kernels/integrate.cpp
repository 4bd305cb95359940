#include "solver/kernels/integrate.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

WallSums wall_forces(Model& model, const Walls& walls, const Bounds& bounds, int grain) {
  WallSums sums;
  if (!walls.present) return sums;
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(model.node_offset[g]);
  const auto count = static_cast<std::size_t>(model.surface_node_count[g]);
  const double stiffness = model.penalty_stiffness[g];
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t axis = side / 2;
    const bool high = side % 2 == 1;
    const double plane = high ? walls.high[axis] : walls.low[axis];
    if (high ? bounds.high[axis] <= plane : bounds.low[axis] >= plane) continue;
    const double inward = high ? -1.0 : 1.0;
    for (std::size_t node = first; node < first + count; ++node) {
      const double gap = inward * (model.position[4 * node + axis] - plane);
      if (!(gap < 0)) continue;
      const double force = -gap * stiffness * model.reference_area[node];
      model.force[4 * node + axis] += inward * force;
      sums.force[side] += force;
      sums.energy += -0.5 * force * gap;
      sums.penetration = std::max(sums.penetration, -gap / model.element_size[g]);
    }
  }
  return sums;
}

void wall_stiffness_rate(const Model& model, const Walls& walls, const Bounds& bounds, int grain,
                         std::span<double> rate) {
  if (!walls.present) return;
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(model.node_offset[g]);
  const auto count = static_cast<std::size_t>(model.surface_node_count[g]);
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t axis = side / 2;
    const bool high = side % 2 == 1;
    const double plane = high ? walls.high[axis] : walls.low[axis];
    if (high ? bounds.high[axis] <= plane : bounds.low[axis] >= plane) continue;
    for (std::size_t node = first; node < first + count; ++node)
      if (const double x = model.position[4 * node + axis]; high ? x > plane : x < plane)
        rate[node] += model.penalty_stiffness[g] * model.reference_area[node] * model.inverse_mass[node];
  }
}

AdvanceSums advance(Model& model, int grain, const Advance& p) {
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(model.node_offset[g]);
  const auto end = static_cast<std::size_t>(model.node_offset[g + 1]);
  double* x = model.position.data();
  double* v = model.velocity.data();
  const double* f = model.force.data();
  const double* inverse_mass = model.inverse_mass.data();

  const bool damped = p.damping_rate > 0;
  double target[4] = {0, 0, 0, 0};
  if (damped) {
    double centre[3] = {0, 0, 0};
    for (std::size_t n = first; n < end; ++n)
      for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] += x[4 * n + axis] / inverse_mass[n];
    for (std::size_t axis = 0; axis < 3; ++axis)
      target[axis] = p.rate[axis] * (centre[axis] / model.mass[g] - p.centre[axis]);
  }
  const double beta = 0.5 * p.damping_rate * p.step_mean;
  const double keep = (1.0 - beta) / (1.0 + beta), gain = p.step_mean / (1.0 + beta), pull = 2.0 * beta / (1.0 + beta);

  AdvanceSums sums;
  double largest = 0;
  for (std::size_t n = first; n < end; ++n) {
    double square = 0, drag_work = 0, drag_square = 0;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const std::size_t i = 4 * n + axis;
      const double before = v[i];
      const double after = keep * before + gain * inverse_mass[n] * f[i] + pull * target[axis];
      square += after * after;
      if (damped) {
        const double mean = 0.5 * (before + after), drag = mean - target[axis];
        drag_work += drag * mean;
        drag_square += drag * drag;
      }
      v[i] = after;
      x[i] += p.step * after;
    }
    if (damped) {
      const double mass = 1.0 / inverse_mass[n];
      sums.damping_work += p.damping_rate * p.step_mean * mass * drag_work;
      sums.damping_force += p.damping_rate * mass * std::sqrt(drag_square);
    }
    largest = std::max(largest, square);
  }
  sums.largest_speed = std::sqrt(largest);
  return sums;
}

double kinetic_energy(const Model& model, int grain, double step_mean) {
  const auto g = static_cast<std::size_t>(grain);
  double energy = 0;
  for (auto n = static_cast<std::size_t>(model.node_offset[g]); n < static_cast<std::size_t>(model.node_offset[g + 1]);
       ++n) {
    double square = 0, work = 0;
    for (std::size_t i = 4 * n; i < 4 * n + 3; ++i) {
      square += model.velocity[i] * model.velocity[i];
      work += model.velocity[i] * model.force[i];
    }
    energy += 0.5 * (square / model.inverse_mass[n] + step_mean * work);
  }
  return energy;
}

} // namespace mpfem
