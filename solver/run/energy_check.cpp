#include "solver/run/energy_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

namespace {

/// Young's modulus times volume, summed over all grains, mJ.
double stiffness_of(const Model& model) {
  double stiffness = 0;
  for (int grain = 0; grain < model.grains; ++grain)
    stiffness += model.material_of(grain).moduli.youngs() * model.reference_volume[static_cast<std::size_t>(grain)];
  return stiffness;
}

} // namespace

EnergyCheck::EnergyCheck(const Model& model, const std::vector<HistoryRow>& history)
    : EnergyCheck(stiffness_of(model)) {
  for (const HistoryRow& row : history) take(row);
}

double EnergyCheck::take(const HistoryRow& row) {
  double sum = 0; // finite only if all terms are
  for (const double term :
       {row.external_work, row.kinetic_energy, row.elastic_energy, row.plastic_dissipation, row.damage_dissipation,
        row.bond_energy, row.contact_energy, row.viscous_dissipation, row.hypoelastic_dissipation,
        row.damping_dissipation, row.friction_energy, row.friction_dissipation}) {
    largest_ = std::max(largest_, std::abs(term));
    sum += term;
  }
  if (!std::isfinite(sum + row.energy_residual)) return std::numeric_limits<double>::quiet_NaN();
  return largest_ > negligible_ ? std::abs(row.energy_residual) / largest_ : 0.0;
}

double EnergyCheck::require(const HistoryRow& row) {
  const double error = take(row);
  if (!(error <= allowed))
    throw SimulationError(fmt::format(
        "step {:.0f}, time {:.4g} s, relative density {:.4f}: the energy balance is off by {:.3g} % of its largest "
        "term, allowed: {:g} %; the motion is not stable; lower numerics.time_step_factor or the speed",
        row.step, row.time, row.relative_density, 100 * error, 100 * allowed));
  return error;
}

} // namespace mpfem
