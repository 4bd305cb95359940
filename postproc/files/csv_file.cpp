#include "postproc/files/csv_file.hpp"

#include <algorithm>
#include <utility>

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
  if (found != names.end() && std::find(found + 1, names.end(), wanted.name) != names.end())
    reader.fail(fmt::format("{}found the column '{}' twice, allowed: every name once",
                            wanted.option.empty() ? "" : wanted.option + ": ", shortened(wanted.name)));
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const auto near = nearest_word(wanted.name, names);
  reader.fail(
      fmt::format("{}found no column '{}'{}", wanted.option.empty() ? "" : wanted.option + ": ", shortened(wanted.name),
                  near ? fmt::format("; did you mean '{}'?", shortened(*near))
                       : fmt::format(", allowed: {}", shortened(fmt::format("{}", fmt::join(names, ", ")), 160))));
}

/// Where the wanted columns are, and these columns without values.
struct Heading {
  std::size_t width; ///< number of columns of the table
  std::vector<std::size_t> places;
  std::vector<Column> columns;
};

Heading read_heading(CsvReader& reader, const std::vector<WantedColumn>& wanted) {
  const auto row = reader.next();
  if (!row) reader.fail("the file is empty, allowed: a heading and rows of numbers");
  std::vector<std::string> names, units;
  for (const std::string_view cell : row->cells) {
    CsvHeading column = csv_heading(cell);
    names.push_back(std::move(column.name));
    units.push_back(column.unit.empty() ? "1" : std::move(column.unit));
  }
  Heading heading{names.size(), {}, {}};
  for (const WantedColumn& column : wanted) {
    const std::size_t place = place_of(column, names, reader);
    heading.places.push_back(place);
    heading.columns.push_back({names[place], units[place], {}});
  }
  return heading;
}

CompleteRows read_rows(CsvReader reader, const std::vector<WantedColumn>& wanted, bool may_be_empty) {
  auto [width, places, columns] = read_heading(reader, wanted);
  std::vector<double> values(columns.size());
  std::size_t left_out = 0;
  while (const auto row = reader.next()) {
    reader.expect_columns(*row, width);
    bool complete = true;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (may_be_empty && row->cells[places[i]].empty())
        complete = false;
      else
        values[i] = reader.number(*row, places[i], columns[i].name);
    if (!complete) {
      ++left_out;
      continue;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].values.push_back(values[i]);
  }
  return {std::move(columns), left_out};
}

} // namespace

std::vector<Column> read_csv(const std::string& path, const std::vector<WantedColumn>& wanted) {
  return read_csv(CsvReader::from_file(path), wanted);
}

std::vector<Column> read_csv(CsvReader reader, const std::vector<WantedColumn>& wanted) {
  return read_rows(std::move(reader), wanted, false).columns;
}

CompleteRows read_complete_rows(const std::string& path, const std::vector<WantedColumn>& wanted) {
  return read_rows(CsvReader::from_file(path), wanted, true);
}

} // namespace mpfem
