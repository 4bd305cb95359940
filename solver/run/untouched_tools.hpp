#pragma once
// Tools that a run drives, but that no grain touches: often of another unit or at another place than meant.

#include <span>
#include <string>
#include <vector>

#include "solver/output/tool_history.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// In words, each tool that a stage drives and that bears no force in any of these rows of the history.
std::vector<std::string> untouched_tools(const Scenario& scenario, std::span<const ToolRow> rows);

} // namespace mpfem
