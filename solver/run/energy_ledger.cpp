#include "solver/run/energy_ledger.hpp"

namespace mpfem {

void EnergyLedger::add_grips(const GripSums& grips) {
  external_work += grip_work_ahead + grips.work_behind;
  grip_work_ahead = grips.work_ahead;
}

void EnergyLedger::add_walls(const std::array<double, 6>& work) {
  for (const double of_wall : work) external_work += of_wall;
}

void EnergyLedger::add_tools(double work, double slip) {
  external_work += work;
  friction_dissipation += slip;
}

void EnergyLedger::add_gravity(double work) {
  external_work += work;
}

void EnergyLedger::leave_with(double energy) {
  external_work -= energy;
}

void EnergyLedger::add_friction(const ContactSums& contact, const WallFrictionSums& walls) {
  friction_dissipation += contact.friction_dissipation + walls.dissipation;
}

void EnergyLedger::add_step(const ElementSums& elements, const AdvanceSums& advance) {
  plastic_dissipation += elements.plastic_work;
  viscous_dissipation += elements.viscous_work;
  hypoelastic_dissipation += elements.hypoelastic_work;
  damping_dissipation += advance.damping_work;
}

} // namespace mpfem
