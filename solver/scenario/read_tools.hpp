#pragma once
// The [[tools]] and the [container] of a scenario, and what tools do in a stage.

#include <optional>
#include <span>
#include <vector>

#include "common/table_reader.hpp"
#include "solver/scenario/tools.hpp"

namespace mpfem {

/// Reads all tools; files are relative to the folder of `scenario_file`. Throws InputError with file, line and column.
std::vector<ToolParameters> read_tools(TableReader& root, const std::string& scenario_file);
/// Reads the container; none where the scenario has none.
std::optional<ContainerParameters> read_container(TableReader& root, std::span<const ToolParameters> tools);
/// Index of the tool with this name, which is the value of `key`.
std::size_t tool_named(const TableReader& table, std::string_view key, const std::string& name,
                       std::span<const ToolParameters> tools);
/// Reads the table [drive] of a stage: one entry for each tool that moves.
std::vector<ToolDrive> read_drives(TableReader& stage, std::span<const ToolParameters> tools,
                                   const std::optional<ContainerParameters>& container);

} // namespace mpfem
