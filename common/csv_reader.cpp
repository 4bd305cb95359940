#include "common/csv_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/number_text.hpp"
#include "common/one_line.hpp"
#include "common/text_input.hpp"
#include "common/trimmed.hpp"

namespace mpfem {

namespace {

constexpr std::size_t most_bytes = std::size_t{256} << 20U;
constexpr std::size_t most_columns = 10'000;

/// Where a character stands in a line outside quotes that open from `begin` on; the line's end if it does not.
std::size_t find_outside_quotes(std::string_view line, char wanted, std::size_t begin) {
  bool quoted = false;
  for (std::size_t i = begin; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == wanted && !quoted) return i;
  }
  return line.size();
}

} // namespace

CsvReader::CsvReader(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {}

CsvReader CsvReader::from_file(const std::string& path) {
  return {read_text_file(path, most_bytes), path};
}

CsvReader CsvReader::from_text(std::string text, std::string name) {
  return {std::move(text), std::move(name)};
}

std::optional<CsvRow> CsvReader::next() {
  while (position_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    std::string_view line = std::string_view(text_).substr(position_, end - position_);
    position_ = end + 1;
    ++line_;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (line_ == 1 && line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
    line = trimmed(line.substr(0, find_outside_quotes(line, '#', 0)), " \t\r");
    if (line.empty()) continue;
    CsvRow row{line_, {}};
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t comma = find_outside_quotes(line, ',', begin);
      if (row.cells.size() == most_columns)
        fail(row, fmt::format("found too many columns, allowed: up to {}", most_columns));
      row.cells.push_back(trimmed(line.substr(begin, comma - begin), " \t\r\""));
      begin = comma + 1;
    }
    return row;
  }
  return std::nullopt;
}

void CsvReader::fail(const CsvRow& row, std::string_view message) const {
  throw InputError(fmt::format("{}:{}: {}", shown_path(name_), row.line, one_line(message)));
}

void CsvReader::fail(std::string_view message) const {
  throw InputError(fmt::format("{}: {}", shown_path(name_), one_line(message)));
}

void CsvReader::expect_columns(const CsvRow& row, std::size_t columns) const {
  if (row.cells.size() != columns) fail(row, fmt::format("found {} columns, allowed: {}", row.cells.size(), columns));
}

double CsvReader::number(const CsvRow& row, std::size_t cell, std::string_view column, const Range& range) const {
  const auto value = finite_number(row.cells[cell]);
  if (!value || !range.contains(*value))
    fail(row, fmt::format("column {}: found '{}', allowed: {}", shortened(column), shortened(row.cells[cell]),
                          allowed_number("a number", range)));
  return *value;
}

long long CsvReader::integer(const CsvRow& row, std::size_t cell, std::string_view column, const Range& range) const {
  const auto value = whole_number(row.cells[cell]);
  if (!value || !range.contains(static_cast<double>(*value)))
    fail(row, fmt::format("column {}: found '{}', allowed: {}", shortened(column), shortened(row.cells[cell]),
                          allowed_number("a whole number", range)));
  return *value;
}

CsvHeading csv_heading(std::string_view cell) {
  const std::size_t bracket = cell.find('[');
  if (bracket == std::string_view::npos) return {std::string(cell), ""};
  const std::string_view unit = cell.substr(bracket + 1);
  return {std::string(trimmed(cell.substr(0, bracket), " \t")), std::string(unit.substr(0, unit.find(']')))};
}

} // namespace mpfem
