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
    if (walls.withdrawn[axis]) continue;
    const bool high = side % 2 == 1;
    const double plane = high ? walls.high[axis] : walls.low[axis];
    if (high ? bounds.high[axis] <= plane : bounds.low[axis] >= plane) continue;
    const double inward = high ? -1.0 : 1.0;
    for (std::size_t node = first; node < first + count; ++node) {
      const double gap = inward * (model.contact_coordinate(node, axis) - plane);
      if (!(gap < 0)) continue;
      const double force = -gap * stiffness * model.local_stiffness(node) * model.reference_area[node];
      model.push_contact_point(node, axis, inward * force);
      sums.force[side] += force;
      sums.energy += -0.5 * force * gap;
      sums.axis_energy[axis] += -0.5 * force * gap;
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
    if (walls.withdrawn[axis]) continue;
    const bool high = side % 2 == 1;
    const double plane = high ? walls.high[axis] : walls.low[axis];
    if (high ? bounds.high[axis] <= plane : bounds.low[axis] >= plane) continue;
    for (std::size_t node = first; node < first + count; ++node)
      if (const double x = model.contact_coordinate(node, axis); high ? x > plane : x < plane) {
        const double stiffness = model.penalty_stiffness[g] * model.local_stiffness(node) * model.reference_area[node];
        rate[node] += stiffness * model.inverse_mass[node];
        if (model.inner_node.empty()) continue;
        const auto inner = static_cast<std::size_t>(model.inner_node[node]);
        rate[inner] += model.inward[node] * stiffness * model.inverse_mass[inner];
      }
  }
}

namespace {

/// Velocity towards which damping draws a grain: that of the affine field at its centre.
std::array<double, 4> drag_target(const Model& model, int grain, const Advance& p) {
  std::array<double, 4> target{};
  if (!(p.damping_rate > 0)) return target;
  const auto g = static_cast<std::size_t>(grain);
  std::array<double, 3> centre{};
  for (auto n = static_cast<std::size_t>(model.node_offset[g]); n < static_cast<std::size_t>(model.node_offset[g + 1]);
       ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] += model.position[4 * n + axis] / model.inverse_mass[n];
  for (std::size_t axis = 0; axis < 3; ++axis)
    target[axis] = p.rate[axis] * (centre[axis] / model.mass[g] - p.centre[axis]);
  return target;
}

/// The damped update v+ = keep v- + gain f/m + pull target.
struct DampedUpdate {
  double keep, gain, pull;
};
DampedUpdate damped_update(const Advance& p) {
  const double beta = 0.5 * p.damping_rate * p.step_mean;
  return {(1.0 - beta) / (1.0 + beta), p.step_mean / (1.0 + beta), 2.0 * beta / (1.0 + beta)};
}

} // namespace

void Grips::make_offsets(std::span<const std::int32_t> node_offset) {
  offset.assign(node_offset.size(), 0);
  for (const GrippedNode& gripped : node) {
    const auto grain = std::upper_bound(node_offset.begin(), node_offset.end(), gripped.node) - node_offset.begin() - 1;
    ++offset[static_cast<std::size_t>(grain) + 1];
  }
  for (std::size_t g = 1; g < offset.size(); ++g) offset[g] += offset[g - 1];
}

Grips grip_nodes(const Model& model, const Walls& box, std::size_t axis, double depth, bool lateral_fixed) {
  Grips grips{.axis = axis, .lateral_fixed = lateral_fixed, .node = {}, .offset = {}};
  for (std::size_t g = 0; g < static_cast<std::size_t>(model.grains); ++g) {
    for (std::int32_t node = model.node_offset[g]; node < model.node_offset[g + 1]; ++node) {
      const double* x = &model.position[4 * static_cast<std::size_t>(node)];
      const bool low = x[axis] - box.low[axis] <= depth, high = box.high[axis] - x[axis] <= depth;
      if (!low && !high) continue;
      GrippedNode gripped{node, low ? 0 : 1, {x[0], x[1], x[2]}};
      gripped.reference[axis] -= low ? box.low[axis] : box.high[axis];
      grips.node.push_back(gripped);
    }
  }
  grips.make_offsets(model.node_offset);
  return grips;
}

GripSums grip_forces(Model& model, const Grips& grips, const Walls& next, const std::array<double, 3>& sliding,
                     const Advance& p, double last_step, int grain) {
  GripSums sums;
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(grips.offset[g]), end = static_cast<std::size_t>(grips.offset[g + 1]);
  if (first == end) return sums;
  const auto target = drag_target(model, grain, p);
  const auto [keep, gain, pull] = damped_update(p);
  for (std::size_t i = first; i < end; ++i) {
    const GrippedNode& gripped = grips.node[i];
    const auto n = static_cast<std::size_t>(gripped.node);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool along = axis == grips.axis;
      if (!along && !grips.lateral_fixed) continue;
      const double face = !along              ? (gripped.side == 0 ? -0.5 : 0.5) * sliding[axis]
                          : gripped.side == 0 ? next.low[axis]
                                              : next.high[axis];
      const double before = model.velocity[4 * n + axis];
      const double after = (face + gripped.reference[axis] - model.position[4 * n + axis]) / p.step;
      double& force = model.force[4 * n + axis];
      const double needed = (after - keep * before - pull * target[axis]) / (gain * model.inverse_mass[n]);
      const double grip = needed - force;
      force = needed;
      if (along) sums.force[static_cast<std::size_t>(gripped.side)] += gripped.side == 0 ? grip : -grip;
      sums.work_behind += 0.5 * grip * before * last_step;
      sums.work_ahead += 0.5 * grip * after * p.step;
    }
  }
  return sums;
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
  const auto target = drag_target(model, grain, p);
  const auto [keep, gain, pull] = damped_update(p);

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

ForceMoments force_moments(const Model& model, const std::array<double, 3>& centre, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  ForceMoments sums;
  for (auto n = static_cast<std::size_t>(model.node_offset[g]); n < static_cast<std::size_t>(model.node_offset[g + 1]);
       ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double force = model.force[4 * n + axis];
      sums.force[axis] += force;
      sums.moment[axis] += force * (model.position[4 * n + axis] - centre[axis]);
    }
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
