#pragma once
// Tables of numbers and texts in CSV files, empty where something could not be measured.

#include <string>
#include <vector>

#include "postproc/figure/figure.hpp"

namespace mpfem {

struct TextTable {
  std::string path;                       ///< for messages
  std::vector<std::string> titles, names; ///< "name [unit]" and "name" of each column
  std::vector<std::vector<Value>> rows;

  void add_column(const std::string& title);
  /// Number of a column; throws InputError with the nearest name.
  std::size_t column(const std::string& name) const;
  std::size_t column(const std::string& name, const Place& place) const;
  /// The values of a row by column.
  Words words(std::size_t row) const;
  /// Numbers of the rows that all filters accept.
  std::vector<std::size_t> rows_of(const std::vector<Filter>& filters, const Place& place) const;
};

/// Where a table of a figure lies: in the folder of its results, or next to the figure's file.
std::string path_of_table(const TableSpec& spec, const std::string& folder);

/// Throws InputError with file and line: no such file, rows of another length than the heading.
TextTable read_text_table(const std::string& path);

/// Throws StorageError; InputError where a text holds a comma or a line's end.
void write_text_table(const std::string& path, const TextTable& table);

} // namespace mpfem
