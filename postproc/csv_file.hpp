#pragma once
// Tables of numbers in CSV files: those that this toolkit writes, and others like them.

#include <string>
#include <vector>

#include "common/csv_reader.hpp"
#include "postproc/history_table.hpp"

namespace mpfem {

/// Columns of a CSV file. The first line that is neither empty nor a comment (#) names them, "name [unit]" with the
/// unit where there is one, quotes allowed; every other such line has a number in each. Throws InputError with file and
/// line.
std::vector<Column> read_csv(const std::string& path);
std::vector<Column> read_csv(CsvReader reader);

/// A column by name, without its unit. Throws InputError with the nearest name.
const Column& csv_column(const std::vector<Column>& columns, const std::string& name, const std::string& path);

} // namespace mpfem
