#include "postproc/metrics/energy.hpp"

#include <cmath>

namespace mpfem {

std::vector<Column> energy_ledger(const HistoryTable& history) {
  std::vector<Column> ledger;
  for (const char* name : {"time", "relative_density", "external_work", "kinetic_energy", "elastic_energy",
                           "plastic_dissipation", "damage_dissipation", "bond_energy", "contact_energy",
                           "viscous_dissipation", "damping_dissipation", "energy_residual"})
    ledger.push_back(history.column(name));
  for (const char* name : {"hypoelastic_dissipation", "friction_energy", "friction_dissipation"})
    if (history.has(name)) ledger.push_back(history.column(name));
  Column residual{"residual_over_work", "1", {}}, kinetic{"kinetic_over_internal", "1", {}};
  const std::vector<double> internal_of_row = internal_energy(history);
  for (std::size_t row = 0; row < history.rows(); ++row) {
    const double work = std::abs(history["external_work"][row]), internal = internal_of_row[row];
    residual.values.push_back(work > 0 ? history["energy_residual"][row] / work : 0.0);
    kinetic.values.push_back(internal > 0 ? history["kinetic_energy"][row] / internal : 0.0);
  }
  ledger.push_back(residual);
  ledger.push_back(kinetic);
  return ledger;
}

} // namespace mpfem
