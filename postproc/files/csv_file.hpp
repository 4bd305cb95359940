#pragma once
// Tables of numbers in CSV files: those that this program writes, and similar ones.

#include <string>
#include <vector>

#include "common/csv_reader.hpp"
#include "postproc/run_data/history_table.hpp"

namespace mpfem {

/// Columns of a CSV file. The first line that is neither empty nor a comment (#) names them: "name [unit]", the unit
/// optional, quotes allowed. Every other such line has a number in each column. Throws InputError with file and line.
std::vector<Column> read_csv(const std::string& path);
/// The same for a table that is already open.
std::vector<Column> read_csv(CsvReader reader);
/// The columns of these names, without units, in this order; the others may hold text. Throws InputError also for a
/// name that no column has, with the nearest one or all.
std::vector<Column> read_csv_columns(const std::string& path, const std::vector<std::string>& wanted);

} // namespace mpfem
