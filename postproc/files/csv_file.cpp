#include "postproc/files/csv_file.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

std::vector<Column> read_csv(const std::string& path) {
  return read_csv(CsvReader::from_file(path));
}

namespace {

/// Columns without values.
std::vector<Column> read_headings(CsvReader& reader) {
  const auto names = reader.next();
  if (!names) reader.fail("the file is empty, allowed: a heading and rows of numbers");
  std::vector<Column> columns;
  for (const std::string_view cell : names->cells) {
    CsvHeading heading = csv_heading(cell);
    columns.push_back({std::move(heading.name), heading.unit.empty() ? "1" : std::move(heading.unit), {}});
  }
  return columns;
}

/// The rest of the table: the values of the columns at these places.
void read_values(CsvReader& reader, std::vector<Column>& columns, const std::vector<std::size_t>& places) {
  while (const auto row = reader.next()) {
    reader.expect_columns(*row, columns.size());
    for (const std::size_t i : places) columns[i].values.push_back(reader.number(*row, i, columns[i].name));
  }
}

std::size_t place_of(const std::vector<Column>& columns, const std::string& name, const std::string& path) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(c.name);
  const auto near = nearest_word(name, names);
  throw InputError(
      fmt::format("{}: no column '{}'{}", shown_path(path), shortened(name),
                  near ? fmt::format("; did you mean '{}'?", shortened(*near))
                       : fmt::format(", allowed: {}", shortened(fmt::format("{}", fmt::join(names, ", ")), 160))));
}

} // namespace

std::vector<Column> read_csv(CsvReader reader) {
  std::vector<Column> columns = read_headings(reader);
  std::vector<std::size_t> all(columns.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  read_values(reader, columns, all);
  return columns;
}

std::vector<Column> read_csv_columns(const std::string& path, const std::vector<std::string>& wanted) {
  CsvReader reader = CsvReader::from_file(path);
  std::vector<Column> columns = read_headings(reader);
  std::vector<std::size_t> places;
  for (const std::string& name : wanted) places.push_back(place_of(columns, name, path));
  std::vector<std::size_t> once = places; // a name may be wanted twice
  std::sort(once.begin(), once.end());
  once.erase(std::unique(once.begin(), once.end()), once.end());
  read_values(reader, columns, once);
  std::vector<Column> found;
  for (const std::size_t place : places) found.push_back(columns[place]);
  return found;
}

} // namespace mpfem
