#pragma once
// Tables of numbers and texts in CSV files; a cell is empty where something could not be measured.

#include <string>
#include <vector>

#include "postproc/figure/figure.hpp"

namespace mpfem {

/// Columns with titles, and rows of cells.
struct TextTable {
  std::string path;                       ///< for messages
  std::vector<std::string> titles, names; ///< "name [unit]" and "name" of each column
  std::vector<std::vector<Value>> rows;
  std::vector<std::string> sources; ///< files from which it was made
  std::vector<std::string> notes;   ///< what a reader must know before using it

  void add_column(const std::string& title);
  bool has(const std::string& name) const;
  /// Index of a column. Throws InputError that suggests the nearest name.
  std::size_t column(const std::string& name) const;
  std::size_t column(const std::string& name, const Place& place) const;
  /// The number in a cell; empty where the cell is. Throws InputError with the place for any other text.
  std::optional<double> number(std::size_t row, std::size_t column, const Place& place) const;
  /// The values of a row by column name.
  Words words(std::size_t row) const;
  /// Indices of the rows that all filters accept.
  std::vector<std::size_t> rows_of(const std::vector<Filter>& filters, const Place& place) const;
};

/// Path of a figure's table: in the folder of its results, or next to the figure's file.
std::string path_of_table(const TableSpec& spec, const std::string& folder);

/// Throws InputError with file and line: no such file, rows and heading of different length.
TextTable read_text_table(const std::string& path);

/// As CSV. Throws InputError where a text contains a comma or a line break.
std::string csv_text(const TextTable& table);

} // namespace mpfem
