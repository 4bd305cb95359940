#include "pack-gen/csv_table.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    result.push_back(trimmed(std::string_view(line).substr(begin, comma - begin)));
    if (comma == std::string::npos) return result;
    begin = comma + 1;
  }
}

std::optional<double> as_number(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? std::optional(value) : std::nullopt;
}

/// "radius [mm]" -> "radius".
std::string without_unit(const std::string& name) {
  return trimmed(std::string_view(name).substr(0, name.find('[')));
}

} // namespace

std::vector<std::vector<double>> read_csv(const std::string& path, const std::vector<std::string>& columns) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be opened", one_line(path)));
  std::vector<std::vector<double>> rows;
  std::string line;
  bool heading_allowed = true;
  for (int number = 1; std::getline(file, line); ++number) {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}:{}: {}; allowed: {}", one_line(path), number, what, fmt::join(columns, ",")));
    };
    const auto texts = cells(line);
    if (texts.size() != columns.size()) fail(fmt::format("found {} columns", texts.size()));
    if (heading_allowed && !as_number(texts[0])) {
      heading_allowed = false;
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (without_unit(texts[i]) != columns[i]) fail(fmt::format("found column '{}'", one_line(texts[i])));
      continue;
    }
    heading_allowed = false;
    std::vector<double> row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto value = as_number(texts[i]);
      if (!value || !std::isfinite(*value))
        fail(fmt::format("column {}: found '{}', expected a number", columns[i], one_line(texts[i])));
      row.push_back(*value);
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError(fmt::format("{}: no rows; allowed: {}", one_line(path), fmt::join(columns, ",")));
  return rows;
}

} // namespace mpfem
