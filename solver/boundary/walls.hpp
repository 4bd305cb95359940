#pragma once
// The six walls of the box, and what they do to one grain.

#include <array>
#include <span>

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

/// Adds the penalty forces of the walls (solver/physics/wall.hpp) on the grain's surface nodes to model.force. `bounds`
/// is the present bounding box of the grain's surface.
WallSums wall_forces(Model& model, const Walls& walls, const Bounds& bounds, int grain);

/// mJ, of each wall in a step: by the trapezoidal rule, which central differences conserve. Forces (N) at its beginning and
/// end, `movement` (mm) inward.
std::array<double, 6> wall_work(const std::array<double, 6>& force_before, const std::array<double, 6>& force,
                                const std::array<double, 6>& movement);

/// Adds K A/m (1/s^2) of the walls that each node touches to `rate` [nodes]: what they add to the frequency squared.
void wall_stiffness_rate(const Model& model, const Walls& walls, const Bounds& bounds, int grain,
                         std::span<double> rate);

} // namespace mpfem
