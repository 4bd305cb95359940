#pragma once
// Small result files: written beside and renamed.

#include <string>
#include <string_view>
#include <vector>

#include "postproc/history_table.hpp"

namespace mpfem {

/// Throws StorageError.
void write_file(const std::string& path, std::string_view content);

/// CSV with the heading "name [unit],…"; all columns have as many values.
std::string csv_text(const std::vector<const Column*>& columns);

} // namespace mpfem
