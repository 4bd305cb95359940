#pragma once
// Wall contact and central differences for one grain.

#include <array>
#include <span>
#include <vector>

#include "solver/kernels/surface.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// The six walls of the box. Side 0 … 5: -x, +x, -y, +y, -z, +z.
struct Walls {
  /// Whether the two walls across an axis are there.
  bool stand(std::size_t axis) const { return present && !withdrawn[axis]; }

  bool present = true;
  std::array<bool, 3> withdrawn{}; ///< axes whose two walls are away, while the others are there
  std::array<double, 3> low{};     ///< mm
  std::array<double, 3> high{};
};

/// Work and force of walls on one grain.
struct WallSums {
  std::array<double, 6> force{};       ///< N, magnitude of the push of each wall
  double energy = 0;                   ///< mJ in the walls' penalty
  std::array<double, 3> axis_energy{}; ///< mJ, the same of each axis's two walls
  double penetration = 0;              ///< largest over h
};

/// Adds to model.force the penalty forces K A (-gap) of the walls on the grain's surface nodes.
WallSums wall_forces(Model& model, const Walls& walls, const Bounds& bounds, int grain);

/// What the velocity update needs besides the forces.
struct Advance {
  double step_mean = 0;           ///< s, between the half steps before and after now
  double step = 0;                ///< s, of the positions
  double damping_rate = 0;        ///< 1/s
  std::array<double, 3> centre{}; ///< of the affine velocity field, mm
  std::array<double, 3> rate{};   ///< its velocity gradient along the axes, 1/s
};

struct AdvanceSums {
  double damping_work = 0;  ///< mJ dissipated in this update
  double damping_force = 0; ///< N, sum of nodal magnitudes
  double largest_speed = 0; ///< mm/s
};

/// v+ = v- + dt f/m with damping towards the affine velocity at the grain's centre, then x + dt v+.
AdvanceSums advance(Model& model, int grain, const Advance& parameters);

/// A node that a grip moves.
struct GrippedNode {
  std::int32_t node;
  std::int32_t side;               ///< 0: the grip at the low face, 1: at the high face
  std::array<double, 3> reference; ///< mm: along the grips' axis from the face, across it the position, when gripped
};

/// The grips of a stage.
struct Grips {
  std::size_t axis = 2;
  bool lateral_fixed = true;
  std::vector<GrippedNode> node;    ///< by grain
  std::vector<std::int32_t> offset; ///< [grains + 1]
  bool present() const { return !node.empty(); }
  /// Sets `offset` from `node` and the grains' first nodes.
  void make_offsets(std::span<const std::int32_t> node_offset);
};

/// Nodes within `depth` (mm) of the two faces of the box along an axis.
Grips grip_nodes(const Model& model, const Walls& box, std::size_t axis, double depth, bool lateral_fixed);

/// Forces and work of grips on one grain.
struct GripSums {
  std::array<double, 2> force{}; ///< N, push of the low and the high grip towards the middle
  double work_behind = 0;        ///< mJ, half of the forces times the step that led here
  double work_ahead = 0;         ///< mJ, half of the forces times the step that follows
};

/// Sets model.force of the gripped nodes so that `advance` with these parameters takes them to where the grips at `next`
/// hold them, the high one having slid across the axis by `sliding` (mm) against the low one. `last_step` in s, the step
/// that led here.
GripSums grip_forces(Model& model, const Grips& grips, const Walls& next, const std::array<double, 3>& sliding,
                     const Advance& parameters, double last_step, int grain);

/// Kinetic energy (mJ) at the time of the positions: sum of m v- . v+ / 2, the form that central differences conserve,
/// with the v+ that `advance` would reach from the present forces without damping.
double kinetic_energy(const Model& model, int grain, double step_mean);

/// What the total forces on a grain's nodes add up to: zero in equilibrium, both of them, over all grains.
struct ForceMoments {
  std::array<double, 3> force{};  ///< N
  std::array<double, 3> moment{}; ///< N mm: along each axis, force times distance from `centre`
};
/// With `centre` in mm, after contact and walls were added.
ForceMoments force_moments(const Model& model, const std::array<double, 3>& centre, int grain);

/// Adds K A/m (1/s^2) of the walls that each node touches to `rate` [nodes]: what they add to the frequency squared.
void wall_stiffness_rate(const Model& model, const Walls& walls, const Bounds& bounds, int grain,
                         std::span<double> rate);

} // namespace mpfem
