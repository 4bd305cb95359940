#pragma once
// The [[stages]] of a scenario.

#include <optional>
#include <span>
#include <vector>

#include "common/table_reader.hpp"
#include "solver/scenario/stages.hpp"

namespace mpfem {

/// What stages need from the rest of the scenario.
struct StageContext {
  double youngs_modulus = 0; ///< MPa, of the grains
  std::span<const ToolParameters> tools{};
  std::optional<ContainerParameters> container{};
};

/// Reads all stages. Throws InputError with file, line and column.
std::vector<Stage> read_stages(TableReader& root, const StageContext& context);

} // namespace mpfem
