#pragma once
// Bonds of a scenario: [bond], and the table `adhesion` of a tool.

#include "common/table_reader.hpp"
#include "solver/scenario/bond_parameters.hpp"

namespace mpfem {

/// Reads the keys of such a table. Throws InputError.
BondParameters read_bond(TableReader table);

} // namespace mpfem
