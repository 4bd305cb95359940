#pragma once
// Laws of bonds as files hold them: four numbers a law, strengths (MPa), fracture energy (N/mm) and softening (0
// exponential, 1 energy).

#include <span>
#include <vector>

#include "solver/physics/bond.hpp"

namespace mpfem {

/// One law after another.
std::vector<double> flatten(std::span<const BondLaw> laws);

/// The reverse; the stiffness stays unset. Whether bonds resist sliding is the same for a whole run, not stored.
std::vector<BondLaw> unflatten_bond_laws(std::span<const double> values, bool normal_only);

} // namespace mpfem
