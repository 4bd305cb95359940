#include "solver/boundary/grips.hpp"

#include <algorithm>

#include "solver/model/damping_target.hpp"

namespace mpfem {

void Grips::make_offsets(std::span<const std::int32_t> node_offset) {
  offset.assign(node_offset.size(), 0);
  for (const GrippedNode& gripped : node) {
    const auto grain = std::upper_bound(node_offset.begin(), node_offset.end(), gripped.node) - node_offset.begin() - 1;
    ++offset[static_cast<std::size_t>(grain) + 1];
  }
  for (std::size_t g = 1; g < offset.size(); ++g) offset[g] += offset[g - 1];
}

Grips grip_nodes(const Model& model, const Cell& cell, std::size_t axis, double depth, bool lateral_fixed) {
  Grips grips{.axis = axis, .lateral_fixed = lateral_fixed, .node = {}, .offset = {}};
  for (const std::int32_t grain : model.own()) {
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t node = model.node_offset[g]; node < model.node_offset[g + 1]; ++node) {
      const double* x = &model.position[4 * static_cast<std::size_t>(node)];
      const bool low = x[axis] - cell.low[axis] <= depth, high = cell.high[axis] - x[axis] <= depth;
      if (!low && !high) continue;
      GrippedNode gripped{node, low ? 0 : 1, {x[0], x[1], x[2]}};
      gripped.reference[axis] -= low ? cell.low[axis] : cell.high[axis];
      grips.node.push_back(gripped);
    }
  }
  grips.make_offsets(model.node_offset);
  return grips;
}

GripSums grip_forces(Model& model, const Grips& grips, const Cell& next, const std::array<double, 3>& sliding,
                     const Advance& p, double last_step, int grain) {
  GripSums sums;
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(grips.offset[g]), end = static_cast<std::size_t>(grips.offset[g + 1]);
  if (first == end) return sums;
  const auto target = damping_target(model, grain, p);
  const DampedUpdate update = damped_update(p);
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
      const double needed = update.force(before, after, model.inverse_mass[n], target[axis]);
      const double grip = needed - force;
      force = needed;
      if (along) sums.force[static_cast<std::size_t>(gripped.side)] += gripped.side == 0 ? grip : -grip;
      sums.work_behind += 0.5 * grip * before * last_step;
      sums.work_ahead += 0.5 * grip * after * p.step;
    }
  }
  return sums;
}

} // namespace mpfem
