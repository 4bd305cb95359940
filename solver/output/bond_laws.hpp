#pragma once
// Laws of bonds as files hold them, six numbers a law: tensile and shear strength (MPa), fracture energy (N/mm),
// softening (0 exponential, 1 energy), stiffness (MPa/mm, 0 if it follows the penalty) and its ratio to that penalty.

#include <span>
#include <vector>

#include "solver/physics/bond.hpp"

namespace mpfem {

/// One law after another.
std::vector<double> flatten(std::span<const BondLaw> laws);

/// The reverse. Whether bonds resist sliding is the same for a whole run, not stored.
std::vector<BondLaw> unflatten_bond_laws(std::span<const double> values, bool normal_only);

} // namespace mpfem
