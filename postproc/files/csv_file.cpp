#include "postproc/files/csv_file.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

std::vector<Column> read_csv(const std::string& path) {
  return read_csv(CsvReader::from_file(path));
}

std::vector<Column> read_csv(CsvReader reader) {
  const auto names = reader.next();
  if (!names) reader.fail("the file is empty, allowed: a heading and rows of numbers");
  std::vector<Column> columns;
  for (const std::string_view cell : names->cells) {
    CsvHeading heading = csv_heading(cell);
    columns.push_back({std::move(heading.name), heading.unit.empty() ? "1" : std::move(heading.unit), {}});
  }
  while (const auto row = reader.next()) {
    reader.expect_columns(*row, columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
      columns[i].values.push_back(reader.number(*row, i, columns[i].name));
  }
  return columns;
}

const Column& csv_column(const std::vector<Column>& columns, const std::string& name, const std::string& path) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  if (found != columns.end()) return *found;
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(c.name);
  const auto near = nearest_word(name, names);
  throw InputError(
      fmt::format("{}: no column '{}'{}", shown_path(path), shortened(name),
                  near ? fmt::format("; did you mean '{}'?", shortened(*near))
                       : fmt::format(", allowed: {}", shortened(fmt::format("{}", fmt::join(names, ", ")), 160))));
}

} // namespace mpfem
