#include "solver/boundary/wall_friction.hpp"

#include <numeric>

namespace mpfem {

namespace {

/// The frame of a wall moves with it along its normal.
SurfaceMotion motion_of(const Plane& plane, double approach, double step) {
  const Vector3<double> normal = plane.normal.vector();
  return {(plane.normal.sign * plane.position) * normal, approach * normal, step};
}

} // namespace

double WallFrictionSums::stored() const {
  return std::accumulate(energy.begin(), energy.end(), 0.0);
}

WallFriction::WallFriction(double friction, int grains) : friction_(friction) {
  if (friction > 0) anchors_.resize(static_cast<std::size_t>(grains));
}

WallFrictionSums WallFriction::add_forces(Model& model, const Box& box, const Bounds& bounds, double last_step,
                                          int grain) {
  WallFrictionSums sums;
  for (std::size_t side = 0; side < 6; ++side) {
    if (!box.has_walls(side / 2)) continue;
    std::vector<SurfaceAnchor>& anchors = this->anchors(grain, side);
    const Plane plane = box.wall(side);
    SurfaceFriction<Plane> wall(model, friction_, plane, motion_of(plane, box.movement(side), last_step), anchors);
    for_each_node_behind(model, plane, bounds, grain, [&](std::size_t node, const auto& gap) {
      wall.add_force(node, gap, surface_force(model, node, grain, gap.distance));
    });
    anchors = wall.finish();
    sums.energy[side] = wall.energy;
    sums.dissipation += wall.dissipation;
  }
  return sums;
}

void WallFriction::forget(const std::array<bool, 3>& axes) {
  for (auto& of_grain : anchors_)
    for (std::size_t side = 0; side < 6; ++side)
      if (axes[side / 2]) of_grain[side].clear();
}

std::array<double, 12> WallFriction::forces_on_grain(int grain) const {
  std::array<double, 12> force{};
  for (std::size_t side = 0; side < 6; ++side)
    for (const SurfaceAnchor& anchor : anchors(grain, side)) {
      const std::array<double, 3> of_node{anchor.force.x, anchor.force.y, anchor.force.z};
      for (std::size_t i = 0; i < 2; ++i) force[2 * side + i] -= of_node[(side / 2 + 1 + i) % 3];
    }
  return force;
}

const std::vector<SurfaceAnchor>& WallFriction::anchors(int grain, std::size_t side) const {
  return anchors_[static_cast<std::size_t>(grain)][side];
}

std::vector<SurfaceAnchor>& WallFriction::anchors(int grain, std::size_t side) {
  return anchors_[static_cast<std::size_t>(grain)][side];
}

} // namespace mpfem
