#include "pack-gen/csv_table.hpp"

#include <fmt/format.h>

#include "common/number_text.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

std::string names_of(const std::vector<CsvColumn>& columns) {
  std::string names;
  for (const CsvColumn& column : columns) names += (names.empty() ? "" : ",") + column.name;
  return names;
}

void check_heading(const CsvReader& reader, const CsvRow& row, const std::vector<CsvColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const CsvHeading heading = csv_heading(row.cells[i]);
    if (heading.name != columns[i].name)
      reader.fail(row, fmt::format("found column '{}', allowed: {}", shortened(row.cells[i]), names_of(columns)));
    if (!heading.unit.empty() && heading.unit != columns[i].unit)
      reader.fail(row, fmt::format("column '{}': found the unit '{}', allowed: {}", columns[i].name,
                                   shortened(heading.unit), columns[i].unit));
  }
}

} // namespace

std::vector<std::vector<double>> read_csv(CsvReader reader, const std::vector<CsvColumn>& columns) {
  std::vector<std::vector<double>> rows;
  bool heading_allowed = true;
  while (const auto row = reader.next()) {
    if (row->cells.size() != columns.size())
      reader.fail(*row, fmt::format("found {} columns, allowed: {}", row->cells.size(), names_of(columns)));
    const bool heading = heading_allowed && !finite_number(row->cells[0]);
    heading_allowed = false;
    if (heading) {
      check_heading(reader, *row, columns);
      continue;
    }
    std::vector<double> values;
    values.reserve(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
      values.push_back(reader.number(*row, i, columns[i].name, columns[i].range));
    rows.push_back(std::move(values));
  }
  if (rows.empty()) reader.fail(fmt::format("found no rows, allowed: rows of {}", names_of(columns)));
  return rows;
}

} // namespace mpfem
