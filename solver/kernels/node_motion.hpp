#pragma once
// Central differences for the nodes of one grain, and sums over their motion and forces.

#include <array>

#include "solver/model/model.hpp"
#include "solver/physics/damping.hpp"

namespace mpfem {

/// Sums over the nodes of one grain in one velocity update.
struct AdvanceSums {
  double damping_work = 0;           ///< mJ dissipated in this update
  double damping_force = 0;          ///< N, sum of nodal magnitudes
  double largest_relative_speed = 0; ///< mm/s, relative to the affine velocity field of the walls

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.damping_work), visit.sum(s.damping_force), visit.largest(s.largest_relative_speed);
  }
};

/// v+ = v- + dt f/m with damping (solver/physics/damping.hpp), then x + dt v+.
AdvanceSums advance(Model& model, int grain, const Advance& parameters);

/// Kinetic energy (mJ) at the time of the positions: sum of m v- . v+ / 2, the form that central differences conserve,
/// with the v+ that `advance` would reach from the current forces without damping. `step_mean` in s.
double kinetic_energy(const Model& model, int grain, double step_mean);

/// mJ, the work of gravity on the nodes of a grain on the way from the origin to where they are: weights are `gravity`
/// (mm/s^2) times masses before mass_factor.
double weight_potential(const Model& model, const std::array<double, 3>& gravity, int grain);
/// Adds the weights of a grain's nodes to model.force. Returns their weight_potential().
double add_weight(Model& model, const std::array<double, 3>& gravity, int grain);

/// Sums of the total forces on a grain's nodes. In equilibrium, both sums over all grains are zero.
struct ForceMoments {
  std::array<double, 3> force{};  ///< N
  std::array<double, 3> moment{}; ///< N mm: along each axis, force times distance from `centre`

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    for (std::size_t axis = 0; axis < 3; ++axis) visit.sum(s.force[axis]), visit.sum(s.moment[axis]);
  }
};
/// `centre` in mm. To be called after the forces of contact and walls were added.
ForceMoments force_moments(const Model& model, const std::array<double, 3>& centre, int grain);

/// Moments of the masses of a grain's nodes.
struct MassMoments {
  double mass = 0;                ///< tonne
  std::array<double, 3> first{};  ///< tonne mm: mass times distance from `centre`
  std::array<double, 3> second{}; ///< tonne mm^2: mass times its square

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.mass);
    for (std::size_t axis = 0; axis < 3; ++axis) visit.sum(s.first[axis]), visit.sum(s.second[axis]);
  }
};
/// `centre` in mm, near the grains: large distances would cost digits.
MassMoments mass_moments(const Model& model, const std::array<double, 3>& centre, int grain);

} // namespace mpfem
