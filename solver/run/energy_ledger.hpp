#pragma once
// The energies that are accumulated over time. All energies, and their balance: solver/run/energy_terms.hpp.

#include <array>

#include "solver/boundary/grips.hpp"
#include "solver/boundary/wall_friction.hpp"
#include "solver/kernels/contact_forces.hpp"
#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/kernels/node_motion.hpp"

namespace mpfem {

/// Energies that are added up step by step since the start of the run.
struct EnergyLedger {
  double initial = 0;                 ///< mJ, of motion and strain at the start
  double plastic_dissipation = 0;     ///< mJ
  double viscous_dissipation = 0;     ///< mJ, of bulk viscosity
  double hypoelastic_dissipation = 0; ///< mJ, that the elastic law does not return (solver/physics/elasticity.hpp)
  double damping_dissipation = 0;     ///< mJ, of mass-proportional damping
  double friction_dissipation = 0;    ///< mJ, of slip between grains, at walls and on tools
  double external_work = 0;           ///< mJ, of walls, grips, tools and gravity
  double grip_work_ahead = 0;         ///< mJ, half of the grips' forces times the step that follows

  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("energy.initial", s.initial), visit("energy.plastic_dissipation", s.plastic_dissipation);
    visit("energy.viscous_dissipation", s.viscous_dissipation);
    visit("energy.hypoelastic_dissipation", s.hypoelastic_dissipation);
    visit("energy.damping_dissipation", s.damping_dissipation);
    visit("energy.friction_dissipation", s.friction_dissipation), visit("energy.external_work", s.external_work);
    visit("energy.grip_work_ahead", s.grip_work_ahead);
  }

  /// Adds what the grips did at this time level.
  void add_grips(const GripSums& grips);
  /// Adds the work (mJ) of the walls since the time level before.
  void add_walls(const std::array<double, 6>& work);
  /// Adds the work (mJ) of the tools since the time level before, and what slip on them dissipated.
  void add_tools(double work, double slip);
  /// Adds the work (mJ) of gravity since the time level before.
  void add_gravity(double work);
  /// Takes out the energy (mJ) that walls or tools take along when they leave.
  void leave_with(double energy);
  /// Adds what friction between grains and at walls dissipated since the time level before.
  void add_friction(const ContactSums& contact, const WallFrictionSums& walls);
  /// Adds what was dissipated in a step.
  void add_step(const ElementSums& elements, const AdvanceSums& advance);
};

} // namespace mpfem
