#include "postproc/csv_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

std::string trimmed(std::string text) {
  constexpr std::string_view blanks = " \t\r\"";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    cells.push_back(trimmed(line.substr(begin, comma == std::string::npos ? comma : comma - begin)));
    if (comma == std::string::npos) return cells;
    begin = comma + 1;
  }
}

Column heading(const std::string& cell) {
  const std::size_t bracket = cell.find('[');
  if (bracket == std::string::npos) return {cell, "1", {}};
  return {trimmed(cell.substr(0, bracket)), cell.substr(bracket + 1, cell.find(']') - bracket - 1), {}};
}

} // namespace

std::vector<Column> read_csv(const std::string& path) {
  const std::string name = one_line(path);
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: no such file, or no permission to read it", name));
  std::vector<Column> columns;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const auto cells = cells_of(line);
    if (columns.empty()) {
      for (const std::string& cell : cells) columns.push_back(heading(cell));
      continue;
    }
    if (cells.size() != columns.size())
      throw InputError(fmt::format("{}:{}: found {} cells, allowed: {}, as in the heading", name, number, cells.size(),
                                   columns.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double value = 0;
      const char* end = cells[i].data() + cells[i].size();
      const auto [stop, error] = std::from_chars(cells[i].data(), end, value);
      if (error != std::errc() || stop != end || !std::isfinite(value))
        throw InputError(fmt::format("{}:{}: column '{}': found '{}', allowed: a finite number", name, number,
                                     one_line(columns[i].name), one_line(cells[i])));
      columns[i].values.push_back(value);
    }
  }
  if (columns.empty())
    throw InputError(fmt::format("{}: the file is empty, allowed: a heading and rows of numbers", name));
  return columns;
}

const Column& csv_column(const std::vector<Column>& columns, const std::string& name, const std::string& path) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  if (found != columns.end()) return *found;
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(one_line(c.name));
  const auto near = nearest_word(name, names);
  throw InputError(fmt::format("{}: no column '{}'; {}", one_line(path), one_line(name),
                               near ? fmt::format("did you mean '{}'?", *near)
                                    : fmt::format("allowed: {}", fmt::join(names, ", "))));
}

} // namespace mpfem
