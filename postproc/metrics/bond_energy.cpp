#include "postproc/metrics/bond_energy.hpp"

namespace mpfem {

std::optional<BondEnergy> bond_energy(std::span<const BondRow> bonds) {
  BondEnergy sum;
  for (const BondRow& bond : bonds) {
    const std::optional<double> to_break = bond.energy_to_break();
    if (!bond.dissipation || !to_break) return {};
    sum.dissipation += *bond.dissipation;
    sum.energy_to_break += *to_break;
  }
  return sum;
}

} // namespace mpfem
