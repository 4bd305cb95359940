#pragma once
// Existing files that a figure's runs and commands name, as prerequisites of a rule for make.

#include <string>

#include "common/table_reader.hpp"
#include "postproc/figure/run_graph.hpp"

namespace mpfem {

/// The files that the words of a command name, a blank before each, and those that a packing's description among them
/// names; without those in the folder `results`, which the command may write.
std::string files_in_command(const std::string& command, const std::string& results);

/// The STL files of a run's tools, a blank before each: relative to the scenario, also where a setting names them.
std::string surfaces_of_tools(const RunInstance& run, const TomlDocument& scenario);

} // namespace mpfem
