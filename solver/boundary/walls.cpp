#include "solver/boundary/walls.hpp"

#include <algorithm>

#include "solver/physics/wall.hpp"

namespace mpfem {

namespace {

/// One of the six walls.
struct Wall {
  std::size_t side, axis;
  double inward; ///< direction into the box along the axis
};

/// Calls f(wall, node, gap in mm) for every surface node of a grain that is behind a wall.
template <class F>
void for_each_node_behind_a_wall(const Model& model, const Walls& walls, const Bounds& bounds, int grain, F&& f) {
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
    const Wall wall{side, axis, high ? -1.0 : 1.0};
    for (std::size_t node = first; node < first + count; ++node)
      if (const double gap = wall_gap(model.contact_coordinate(node, axis), plane, wall.inward); gap < 0)
        f(wall, node, gap);
  }
}

} // namespace

WallSums wall_forces(Model& model, const Walls& walls, const Bounds& bounds, int grain) {
  WallSums sums;
  const auto g = static_cast<std::size_t>(grain);
  const double penalty = model.penalty_stiffness[g];
  for_each_node_behind_a_wall(model, walls, bounds, grain, [&](const Wall& wall, std::size_t node, double gap) {
    const double force = wall_force(gap, penalty, model.local_stiffness(node), model.reference_area[node]);
    model.push_contact_point(node, wall.axis, wall.inward * force);
    sums.force[wall.side] += force;
    sums.energy += wall_energy(force, gap);
    sums.axis_energy[wall.axis] += wall_energy(force, gap);
    sums.penetration = std::max(sums.penetration, -gap / model.element_size[g]);
  });
  return sums;
}

void wall_stiffness_rate(const Model& model, const Walls& walls, const Bounds& bounds, int grain,
                         std::span<double> rate) {
  const double penalty = model.penalty_stiffness[static_cast<std::size_t>(grain)];
  for_each_node_behind_a_wall(model, walls, bounds, grain, [&](const Wall&, std::size_t node, double) {
    const double stiffness = penalty * model.local_stiffness(node) * model.reference_area[node];
    rate[node] += stiffness * model.inverse_mass[node];
    if (model.inner_node.empty()) return;
    const auto inner = static_cast<std::size_t>(model.inner_node[node]);
    rate[inner] += model.inward[node] * stiffness * model.inverse_mass[inner];
  });
}

std::array<double, 6> wall_work(const std::array<double, 6>& force_before, const std::array<double, 6>& force,
                                const std::array<double, 6>& movement) {
  std::array<double, 6> work{};
  for (std::size_t side = 0; side < 6; ++side) work[side] = 0.5 * (force[side] + force_before[side]) * movement[side];
  return work;
}

} // namespace mpfem
