#pragma once
// Grains against a rigid surface, whatever its shape.
//
// A surface says how far a point is from it and in which direction it pushes; everything else is here. Its type is
// known when the loops below are compiled: the gap of a node costs no call. The penalty law is that of
// solver/physics/wall.hpp.

#include <concepts>
#include <cstddef>
#include <span>

#include "solver/model/model.hpp"
#include "solver/physics/wall.hpp"

namespace mpfem {

/// Distance (mm) of a point from a surface, negative behind it, and the unit normal towards the grains. `Normal` has
/// `push`, which adds a force along it to a node, and `vector`, which gives its components.
template <class Normal>
struct RigidGap {
  double distance;
  Normal normal;
};

/// The point at which a surface node touches; coordinates (mm) are computed when they are read.
struct NodePoint {
  const Model& model;
  std::size_t node;
  double operator()(std::size_t axis) const { return model.contact_coordinate(node, axis); }
};

/// What a type must offer to be used as a surface below.
template <class Surface>
concept RigidSurface = requires(const Surface& surface, const NodePoint& point, const Bounds& bounds, Model& model) {
  /// False if no point within the bounds can lie behind the surface.
  { surface.may_touch(bounds) } -> std::same_as<bool>;
  { surface.gap(point).distance } -> std::convertible_to<double>;
  /// Adds a force (N) along the normal to the contact point of a node.
  surface.gap(point).normal.push(model, std::size_t{}, double{});
  { surface.gap(point).normal.vector() } -> std::same_as<Vector3<double>>;
};

/// The gap of a point at any distance in front. A surface whose `gap` is exact only up to a distance has `exact_gap`.
template <class Surface, class Point>
auto gap_at_any_distance(const Surface& surface, const Point& point) {
  if constexpr (requires { surface.exact_gap(point); })
    return surface.exact_gap(point);
  else
    return surface.gap(point);
}

/// What a surface bears and stores.
struct SurfaceLoad {
  double force = 0;       ///< N, sum of the normal forces
  double penetration = 0; ///< the largest, over the element size
  double energy = 0;      ///< mJ, in the penalty

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.force), visit.largest(s.penetration), visit.sum(s.energy);
  }
};

/// The push on one node.
struct SurfacePush {
  double force;       ///< N
  double energy;      ///< mJ
  double penetration; ///< over the grain's element size
};

/// Calls visit(node, gap) for every surface node of a grain that is behind the surface.
template <RigidSurface Surface, class Visitor>
void for_each_node_behind(const Model& model, const Surface& surface, int grain, Visitor&& visit) {
  const std::size_t first = model.first_node(grain);
  const auto count = static_cast<std::size_t>(model.surface_node_count[static_cast<std::size_t>(grain)]);
  for (std::size_t node = first; node < first + count; ++node)
    if (const auto gap = surface.gap(NodePoint{model, node}); gap.distance < 0) visit(node, gap);
}

/// The same, but skips all nodes if the surface cannot touch `bounds`, those of the grain's surface.
template <RigidSurface Surface, class Visitor>
void for_each_node_behind(const Model& model, const Surface& surface, const Bounds& bounds, int grain,
                          Visitor&& visit) {
  if (surface.may_touch(bounds)) for_each_node_behind(model, surface, grain, visit);
}

/// Force (N) with which a surface at `distance` < 0 (mm) pushes a node of a grain.
inline double surface_force(const Model& model, std::size_t node, int grain, double distance) {
  return wall_force(distance, model.penalty_stiffness[static_cast<std::size_t>(grain)], model.local_stiffness(node),
                    model.reference_area[node]);
}

/// Adds the forces of a surface on a grain to model.force, and calls visit(SurfacePush) for every node that it pushes.
template <RigidSurface Surface, class Visitor>
void add_surface_forces(Model& model, const Surface& surface, const Bounds& bounds, int grain, Visitor&& visit) {
  const double size = model.element_size[static_cast<std::size_t>(grain)];
  for_each_node_behind(model, surface, bounds, grain, [&](std::size_t node, const auto& gap) {
    const double force = surface_force(model, node, grain, gap.distance);
    gap.normal.push(model, node, force);
    visit(SurfacePush{force, wall_energy(force, gap.distance), -gap.distance / size});
  });
}

/// Adds to `rate` (1/s^2) [nodes] what a spring of `stiffness` (N/mm) at a node's contact point adds to the frequency
/// squared.
inline void add_node_stiffness_rate(const Model& model, std::size_t node, double stiffness, std::span<double> rate) {
  rate[node] += stiffness * model.inverse_mass[node];
  if (model.inner_node.empty()) return;
  const auto inner = static_cast<std::size_t>(model.inner_node[node]);
  rate[inner] += model.inward[node] * stiffness * model.inverse_mass[inner];
}

/// Adds K A/m (1/s^2) of a surface to `rate` [nodes] of the nodes that it touches: what it adds to the frequency
/// squared.
template <RigidSurface Surface>
void add_surface_stiffness_rate(const Model& model, const Surface& surface, const Bounds& bounds, int grain,
                                std::span<double> rate) {
  const double penalty = model.penalty_stiffness[static_cast<std::size_t>(grain)];
  for_each_node_behind(model, surface, bounds, grain, [&](std::size_t node, const auto&) {
    add_node_stiffness_rate(model, node, penalty * model.local_stiffness(node) * model.reference_area[node], rate);
  });
}

} // namespace mpfem
