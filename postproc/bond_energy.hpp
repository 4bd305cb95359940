#pragma once
// Damage by energy: what bonds have dissipated over what it takes to break them all.

#include <optional>
#include <span>

#include "postproc/bond_table.hpp"

namespace mpfem {

struct BondEnergy {
  double dissipation = 0;     ///< mJ, by damage so far
  double energy_to_break = 0; ///< mJ: G^c times area, each side of a contact with half of its own
  double share() const { return energy_to_break > 0 ? dissipation / energy_to_break : 0.0; }
};

/// Of all bonds together; nothing where a bond does not tell its own. Where bonds form anew after they broke, what the
/// earlier ones dissipated counts too, and the share may exceed 1.
std::optional<BondEnergy> bond_energy(std::span<const BondRow> bonds);

} // namespace mpfem
