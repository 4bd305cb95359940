#include "solver/kernels/node_motion.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/damping_target.hpp"

namespace mpfem {

AdvanceSums advance(Model& model, int grain, const Advance& p) {
  const std::size_t first = model.first_node(grain), end = model.end_node(grain);
  double* x = model.position.data();
  double* v = model.velocity.data();
  const double* f = model.force.data();
  const double* inverse_mass = model.inverse_mass.data();

  const bool damped = p.damping_rate > 0;
  const auto target = damping_target(model, grain, p);
  const DampedUpdate update = damped_update(p);
  // The field as a linear function of the position, 0 in the spare column.
  double at_origin[4] = {}, rate[4] = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
    at_origin[axis] = affine_velocity(p, axis, 0.0), rate[axis] = p.rate[axis];

  AdvanceSums sums;
  double largest = 0;
  for (std::size_t n = first; n < end; ++n) {
    double square = 0, drag_work = 0, drag_square = 0;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const std::size_t i = 4 * n + axis;
      const double before = v[i];
      const double after = update.velocity(before, inverse_mass[n], f[i], target[axis]);
      const double relative = after - (at_origin[axis] + rate[axis] * x[i]);
      square += relative * relative;
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
  sums.largest_relative_speed = std::sqrt(largest);
  return sums;
}

namespace {

/// Calls visit(component, weight) for each component (4 * node + axis) of the weights (N) of a grain's nodes.
template <class Visit>
void for_each_weight(const Model& model, const std::array<double, 3>& gravity, int grain, Visit&& visit) {
  for (std::size_t n = model.first_node(grain); n < model.end_node(grain); ++n) {
    const double inverse_own_mass = model.inverse_mass[n] * (model.mass_factor.empty() ? 1.0 : model.mass_factor[n]);
    for (std::size_t axis = 0; axis < 3; ++axis) visit(4 * n + axis, gravity[axis] / inverse_own_mass);
  }
}

} // namespace

double weight_potential(const Model& model, const std::array<double, 3>& gravity, int grain) {
  double work = 0;
  for_each_weight(model, gravity, grain,
                  [&](std::size_t component, double weight) { work += weight * model.position[component]; });
  return work;
}

double add_weight(Model& model, const std::array<double, 3>& gravity, int grain) {
  for_each_weight(model, gravity, grain,
                  [&](std::size_t component, double weight) { model.force[component] += weight; });
  return weight_potential(model, gravity, grain);
}

ForceMoments force_moments(const Model& model, const std::array<double, 3>& centre, int grain) {
  ForceMoments sums;
  for (std::size_t n = model.first_node(grain); n < model.end_node(grain); ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double force = model.force[4 * n + axis];
      sums.force[axis] += force;
      sums.moment[axis] += force * (model.position[4 * n + axis] - centre[axis]);
    }
  return sums;
}

MassMoments mass_moments(const Model& model, const std::array<double, 3>& centre, int grain) {
  MassMoments sums;
  for (std::size_t n = model.first_node(grain); n < model.end_node(grain); ++n) {
    const double mass = 1.0 / model.inverse_mass[n];
    sums.mass += mass;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double distance = model.position[4 * n + axis] - centre[axis];
      sums.first[axis] += mass * distance;
      sums.second[axis] += mass * distance * distance;
    }
  }
  return sums;
}

double kinetic_energy(const Model& model, int grain, double step_mean) {
  double energy = 0;
  for (std::size_t n = model.first_node(grain); n < model.end_node(grain); ++n) {
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
