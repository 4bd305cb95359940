#include "solver/run/energy_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpfem {

double EnergyCheck::take(const HistoryRow& row) {
  double sum = 0; // finite only if all terms are
  for (const double term : {row.external_work, row.kinetic_energy, row.elastic_energy, row.plastic_dissipation,
                            row.damage_dissipation, row.bond_energy, row.contact_energy, row.viscous_dissipation,
                            row.damping_dissipation, row.friction_energy, row.friction_dissipation}) {
    largest_ = std::max(largest_, std::abs(term));
    sum += term;
  }
  if (!std::isfinite(sum + row.energy_residual)) return std::numeric_limits<double>::quiet_NaN();
  return largest_ > negligible_ ? std::abs(row.energy_residual) / largest_ : 0.0;
}

} // namespace mpfem
