#include "postproc/figure/text_table.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    cells.push_back(line.substr(begin, comma == std::string::npos ? comma : comma - begin));
    if (comma == std::string::npos) return cells;
    begin = comma + 1;
  }
}

std::string no_column(const TextTable& table, const std::string& name) {
  return fmt::format("{} has no column '{}'{}", one_line(table.path), one_line(name), suggestion(name, table.names));
}

std::string line_of(const std::vector<std::string>& cells, const std::string& path) {
  for (const std::string& cell : cells)
    if (cell.find_first_of(",\n") != std::string::npos)
      throw InputError(fmt::format("{}: found the cell '{}', allowed: no commas", one_line(path), one_line(cell)));
  return fmt::format("{}\n", fmt::join(cells, ","));
}

} // namespace

void TextTable::add_column(const std::string& title) {
  titles.push_back(title);
  names.push_back(title.substr(0, title.find(" [")));
}

bool TextTable::has(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::size_t TextTable::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(no_column(*this, name));
  return static_cast<std::size_t>(found - names.begin());
}

std::size_t TextTable::column(const std::string& name, const Place& place) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) place.fail(no_column(*this, name));
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<double> TextTable::number(std::size_t row, std::size_t column, const Place& place) const {
  const Value& cell = rows[row][column];
  if (!cell.number && !cell.text.empty())
    place.fail(fmt::format("{}: found '{}' in the column '{}', allowed: finite numbers and empty cells", one_line(path),
                           one_line(cell.text), one_line(names[column])));
  return cell.number;
}

Words TextTable::words(std::size_t row) const {
  Words words;
  for (std::size_t i = 0; i < names.size(); ++i) words[names[i]] = rows[row][i];
  return words;
}

std::vector<std::size_t> TextTable::rows_of(const std::vector<Filter>& filters, const Place& place) const {
  std::vector<std::size_t> columns;
  for (const Filter& filter : filters) columns.push_back(column(filter.name, place));
  std::vector<std::size_t> accepted;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    bool all = true;
    for (std::size_t i = 0; i < filters.size(); ++i) all = all && filters[i].accepts(rows[row][columns[i]]);
    if (all) accepted.push_back(row);
  }
  return accepted;
}

std::string path_of_table(const TableSpec& spec, const std::string& folder) {
  if (spec.beside) return spec.file;
  return spec.file.empty() ? fmt::format("{}/{}.csv", folder, spec.name) : fmt::format("{}/{}", folder, spec.file);
}

TextTable read_text_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: no such file, or no permission to read it", one_line(path)));
  TextTable table;
  table.path = path;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const auto cells = cells_of(line);
    if (table.names.empty()) {
      for (const std::string& cell : cells) table.add_column(cell);
      continue;
    }
    if (cells.size() != table.names.size())
      throw InputError(fmt::format("{}:{}: found {} cells, allowed: {}, as in the heading", one_line(path), number,
                                   cells.size(), table.names.size()));
    std::vector<Value> row;
    for (const std::string& cell : cells) row.push_back(Value::of_text(cell));
    table.rows.push_back(std::move(row));
  }
  if (table.names.empty()) throw InputError(fmt::format("{}: the file is empty, allowed: a heading", one_line(path)));
  return table;
}

std::string csv_text(const TextTable& table) {
  std::string text = line_of(table.titles, table.path);
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (const Value& value : row) cells.push_back(value.text);
    text += line_of(cells, table.path);
  }
  return text;
}

} // namespace mpfem
