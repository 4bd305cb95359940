#pragma once
// The table [material.hardening] of a scenario.

#include "common/table_reader.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Reads the flow curve of a material whose elastic constants are known. Throws InputError with file, line and column.
HardeningParameters read_hardening(TableReader table, const MaterialParameters& material);

} // namespace mpfem
