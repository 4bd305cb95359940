#pragma once
// Damage by energy: what the bonds have dissipated, over the energy that breaks them all.

#include <optional>
#include <span>

#include "postproc/run_data/bond_table.hpp"

namespace mpfem {

/// What the bonds have dissipated, and the energy that breaks them all.
struct BondEnergy {
  double dissipation = 0;     ///< mJ, by damage up to now
  double energy_to_break = 0; ///< mJ: G^c times area, each side of a contact counts half of its own
  double share() const { return energy_to_break > 0 ? dissipation / energy_to_break : 0.0; }
};

/// Sums over all bonds; empty where a bond lacks its energies. The dissipation of bonds that broke and formed again
/// includes that of the earlier bonds, so the share may exceed 1.
std::optional<BondEnergy> bond_energy(std::span<const BondRow> bonds);

} // namespace mpfem
