#pragma once
// Small result files.

#include <string>
#include <vector>

#include "common/output_file.hpp"
#include "postproc/run_data/history_table.hpp"

namespace mpfem {

/// CSV with the heading "name [unit],…"; all columns must have the same number of values.
std::string csv_text(const std::vector<const Column*>& columns);
/// The same for columns that are given by value.
std::string csv_text(const std::vector<Column>& columns);

/// "NAME [UNIT]", or "NAME" for the unit 1.
std::string name_with_unit(const std::string& name, const std::string& unit);

} // namespace mpfem
