#pragma once
// The [[stages]] of a scenario.

#include <vector>

#include "common/table_reader.hpp"
#include "solver/scenario/stages.hpp"

namespace mpfem {

/// Reads all stages. `youngs_modulus` in MPa, of the grains. Throws InputError with file, line and column.
std::vector<Stage> read_stages(TableReader& root, double youngs_modulus);

} // namespace mpfem
