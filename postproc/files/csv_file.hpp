#pragma once
// Tables in CSV files: those that this program writes, and similar ones.

#include <cstddef>
#include <string>
#include <vector>

#include "common/csv_reader.hpp"
#include "postproc/run_data/history_table.hpp"

namespace mpfem {

/// A column to read: its name without unit, and the option that gives this name, if one does.
struct WantedColumn {
  std::string name;
  std::string option = {}; ///< "--x"; begins the message where there is no such column
};

/// The wanted columns of a CSV file, in the order in which they are wanted. The first line that is neither empty nor a
/// comment (#) names all columns: "name [unit]", the unit optional, quotes allowed. Every other such line has a number
/// in each of the wanted columns; the others may hold text. Throws InputError with file and line; for a name that is
/// not there it suggests the nearest one.
std::vector<Column> read_csv(const std::string& path, const std::vector<WantedColumn>& wanted);
/// The same for a table that is already open.
std::vector<Column> read_csv(CsvReader reader, const std::vector<WantedColumn>& wanted);

/// Rows of a table in which no wanted column is empty.
struct CompleteRows {
  std::vector<Column> columns;
  std::size_t left_out = 0; ///< other rows
};

/// As read_csv, but without the rows in which a wanted column is empty: a value could not be measured there. What else
/// these rows have in wanted columns must be numbers all the same.
CompleteRows read_complete_rows(const std::string& path, const std::vector<WantedColumn>& wanted);

} // namespace mpfem
