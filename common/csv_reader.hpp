#pragma once
// Tables of comma-separated values: lines of cells; '#' begins a comment; blank lines are skipped. Within quotes, a
// comma and a '#' are text.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/range.hpp"

namespace mpfem {

/// A column as a heading names it: "radius [mm]" or radius.
struct CsvHeading {
  std::string name, unit; ///< the unit is empty if there is none
};

/// One line of a table. Cells are trimmed of blanks and quotes, and live as long as the reader.
struct CsvRow {
  std::size_t line = 0; ///< from 1
  std::vector<std::string_view> cells;
};

/// Walks through the rows of a table. Every mistake is an InputError "FILE:LINE: …".
class CsvReader {
public:
  /// Reads a file of at most 256 MiB.
  static CsvReader from_file(const std::string& path);
  /// `name` stands for the file in messages.
  static CsvReader from_text(std::string text, std::string name);

  /// The next row that has text, or nothing at the end.
  std::optional<CsvRow> next();

  /// Throws "FILE:LINE: " + message.
  [[noreturn]] void fail(const CsvRow& row, std::string_view message) const;
  /// Throws "FILE: " + message.
  [[noreturn]] void fail(std::string_view message) const;
  /// Throws if the row has another number of cells.
  void expect_columns(const CsvRow& row, std::size_t columns) const;
  /// The finite number in a cell. `column` names it in the message.
  double number(const CsvRow& row, std::size_t cell, std::string_view column, const Range& range = {}) const;
  /// The whole number in a cell.
  long long integer(const CsvRow& row, std::size_t cell, std::string_view column, const Range& range = {}) const;

private:
  CsvReader(std::string text, std::string name);

  std::string text_, name_;
  std::size_t position_ = 0, line_ = 0;
};

/// A cell of a heading as name and unit.
CsvHeading csv_heading(std::string_view cell);

} // namespace mpfem
