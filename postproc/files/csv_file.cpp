#include "postproc/files/csv_file.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

/// The number of a column by its name. Throws InputError.
std::size_t place_of(const WantedColumn& wanted, const std::vector<std::string>& names, const CsvReader& reader) {
  const auto found = std::find(names.begin(), names.end(), wanted.name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const auto near = nearest_word(wanted.name, names);
  reader.fail(
      fmt::format("{}found no column '{}'{}", wanted.option.empty() ? "" : wanted.option + ": ", shortened(wanted.name),
                  near ? fmt::format("; did you mean '{}'?", shortened(*near))
                       : fmt::format(", allowed: {}", shortened(fmt::format("{}", fmt::join(names, ", ")), 160))));
}

} // namespace

std::vector<Column> read_csv(const std::string& path, const std::vector<WantedColumn>& wanted) {
  return read_csv(CsvReader::from_file(path), wanted);
}

std::vector<Column> read_csv(CsvReader reader, const std::vector<WantedColumn>& wanted) {
  const auto heading = reader.next();
  if (!heading) reader.fail("the file is empty, allowed: a heading and rows of numbers");
  std::vector<std::string> names, units;
  for (const std::string_view cell : heading->cells) {
    CsvHeading column = csv_heading(cell);
    names.push_back(std::move(column.name));
    units.push_back(column.unit.empty() ? "1" : std::move(column.unit));
  }
  std::vector<std::size_t> places;
  std::vector<Column> columns;
  for (const WantedColumn& column : wanted) {
    places.push_back(place_of(column, names, reader));
    columns.push_back({names[places.back()], units[places.back()], {}});
  }
  while (const auto row = reader.next()) {
    reader.expect_columns(*row, names.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
      columns[i].values.push_back(reader.number(*row, places[i], columns[i].name));
  }
  return columns;
}

} // namespace mpfem
