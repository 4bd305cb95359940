#pragma once
// Wall contact and central differences for one grain.

#include <array>

#include "solver/kernels/surface.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// The six walls of the box. Side 0 … 5: -x, +x, -y, +y, -z, +z.
struct Walls {
  bool present = true;
  std::array<double, 3> low{}; ///< mm
  std::array<double, 3> high{};
};

/// Work and force of walls on one grain.
struct WallSums {
  std::array<double, 6> force{}; ///< N, magnitude of the push of each wall
  double energy = 0;             ///< mJ in the walls' penalty
  double penetration = 0;        ///< largest over h
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

/// Kinetic energy (mJ) at the time of the positions: sum of m v- . v+ / 2, the form that central differences conserve,
/// with the v+ that `advance` would reach from the present forces without damping.
double kinetic_energy(const Model& model, int grain, double step_mean);

/// Adds K A/m (1/s^2) of the walls that each node touches to `rate` [nodes]: what they add to the frequency squared.
void wall_stiffness_rate(const Model& model, const Walls& walls, const Bounds& bounds, int grain,
                         std::span<double> rate);

} // namespace mpfem
