#pragma once
// Small result files: written beside and renamed.

#include <string>
#include <string_view>
#include <vector>

#include "postproc/history_table.hpp"

namespace mpfem {

/// Throws InputError where `output` is the same file as `input`, which would be lost.
void refuse_overwriting(const std::string& output, const std::string& input);

/// Throws StorageError.
void write_file(const std::string& path, std::string_view content);

/// CSV with the heading "name [unit],…"; all columns have as many values.
std::string csv_text(const std::vector<const Column*>& columns);
std::string csv_text(const std::vector<Column>& columns);

} // namespace mpfem
