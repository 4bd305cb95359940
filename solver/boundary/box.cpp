#include "solver/boundary/box.hpp"

#include <algorithm>

namespace mpfem {

double BoxSums::penetration() const {
  double largest = 0;
  for (const SurfaceLoad& load : wall) largest = std::max(largest, load.penetration);
  return largest;
}

Plane Box::wall(std::size_t side) const {
  const std::size_t axis = side / 2;
  return side % 2 == 0 ? Plane{{axis, 1.0}, cell_.low[axis]} : Plane{{axis, -1.0}, cell_.high[axis]};
}

BoxSums Box::add_forces(Model& model, const Bounds& bounds, int grain) const {
  BoxSums sums;
  for (std::size_t side = 0; side < 6; ++side) {
    if (!has_walls(side / 2)) continue;
    SurfaceLoad& load = sums.wall[side];
    add_surface_forces(model, wall(side), bounds, grain, [&](const SurfacePush& push) {
      load.force += push.force;
      load.energy += push.energy;
      sums.energy += push.energy;
      load.penetration = std::max(load.penetration, push.penetration);
    });
  }
  return sums;
}

double Box::wall_force_on_node(const Model& model, std::size_t node, int grain) const {
  double force = 0;
  for (std::size_t side = 0; side < 6; ++side) {
    if (!has_walls(side / 2)) continue;
    const double distance = wall(side).gap(NodePoint{model, node}).distance;
    if (distance < 0) force += surface_force(model, node, grain, distance);
  }
  return force;
}

std::array<double, 6> Box::wall_forces_on_grain(const Model& model, int grain) const {
  std::array<double, 6> force{};
  for (std::size_t side = 0; side < 6; ++side)
    if (has_walls(side / 2))
      for_each_node_behind(model, wall(side), grain, [&](std::size_t node, const auto& gap) {
        force[side] += surface_force(model, node, grain, gap.distance);
      });
  return force;
}

void Box::add_stiffness_rate(const Model& model, const Bounds& bounds, int grain, std::span<double> rate) const {
  for (std::size_t side = 0; side < 6; ++side)
    if (has_walls(side / 2)) add_surface_stiffness_rate(model, wall(side), bounds, grain, rate);
}

std::array<double, 6> Box::take_loads(const std::array<double, 6>& contact, const std::array<double, 6>& grip) {
  std::array<double, 6> work{};
  for (std::size_t side = 0; side < 6; ++side) {
    work[side] = 0.5 * (contact[side] + force_[side]) * movement_[side];
    force_[side] = grip[side] + contact[side];
  }
  movement_ = {};
  mean_stress_ = 0;
  for (const double stress : stress()) mean_stress_ += stress / 6.0;
  return work;
}

void Box::move_to(const Cell& next) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    movement_[2 * axis] = has_walls(axis) ? next.low[axis] - cell_.low[axis] : 0.0;
    movement_[2 * axis + 1] = has_walls(axis) ? cell_.high[axis] - next.high[axis] : 0.0;
  }
  cell_ = next;
}

std::array<double, 3> Box::axis_force() const {
  std::array<double, 3> mean{};
  for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] = 0.5 * (force_[2 * axis] + force_[2 * axis + 1]);
  return mean;
}

std::array<double, 6> Box::stress() const {
  std::array<double, 6> stress{};
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t axis = side / 2;
    stress[side] = force_[side] / cell_.area(axis);
  }
  return stress;
}

void Box::move_clear(std::size_t axis, std::span<const Bounds> grains) {
  for (const Bounds& bounds : grains) {
    cell_.low[axis] = std::min(cell_.low[axis], bounds.low[axis]);
    cell_.high[axis] = std::max(cell_.high[axis], bounds.high[axis]);
  }
  for (std::size_t side = 2 * axis; side < 2 * axis + 2; ++side) force_[side] = movement_[side] = 0;
}

} // namespace mpfem
