#pragma once
// Tables of numbers with known columns.

#include <string>
#include <vector>

#include "common/csv_reader.hpp"
#include "common/range.hpp"

namespace mpfem {

/// A column's name, the numbers that are allowed in it, and their unit ("1" for pure numbers).
struct CsvColumn {
  std::string name;
  Range range;
  std::string unit = "mm";
};

/// Rows of a CSV table with exactly these columns, in this order. A first line that does not hold numbers is the
/// heading and must name the columns. The column's unit may follow each name, in brackets. Throws InputError
/// "FILE:LINE: …".
std::vector<std::vector<double>> read_csv(CsvReader reader, const std::vector<CsvColumn>& columns);

} // namespace mpfem
