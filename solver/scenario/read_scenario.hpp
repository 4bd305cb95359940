#pragma once
// The reader of scenarios.

#include "solver/scenario/scenario.hpp"

namespace mpfem {

class TomlDocument;

/// Reads a scenario. Throws InputError with file, line and column for any mistake.
Scenario read_scenario(const TomlDocument& document);

} // namespace mpfem
