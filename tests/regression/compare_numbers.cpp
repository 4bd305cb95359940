// compare-numbers TOLERANCES KEPT FOUND: holds tables to kept ones, number by number.
//
// TOLERANCES is a table with the columns table, column, relative, absolute, times_uncertainty, why. `table` is a CSV
// file below KEPT and FOUND, `column` one of its columns without the unit. A number may differ from the kept one by the
// largest of relative * |kept|, absolute, and times_uncertainty * the kept value of the column NAME_uncertainty. Rows
// are taken in order; texts and the number of rows must agree. Exit code 0: all within; 1: some are not; 2: a file
// cannot be used.

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/csv_reader.hpp"
#include "common/errors.hpp"

namespace {

using namespace mpfem;

struct Tolerance {
  std::string table, column;
  double relative = 0, absolute = 0, times_uncertainty = 0;
};

/// Cells of a table as texts.
struct Table {
  std::vector<std::string> name; ///< of columns, without units
  std::vector<std::vector<std::string>> rows;
  std::optional<std::size_t> column(const std::string& wanted) const {
    for (std::size_t i = 0; i < name.size(); ++i)
      if (name[i] == wanted) return i;
    return std::nullopt;
  }
};

Table read_table(const std::string& path) {
  CsvReader reader = CsvReader::from_file(path);
  Table table;
  while (const auto row = reader.next()) {
    std::vector<std::string> cells(row->cells.begin(), row->cells.end());
    if (table.name.empty())
      for (const std::string& cell : cells) table.name.push_back(csv_heading(cell).name);
    else
      table.rows.push_back(cells);
  }
  return table;
}

std::vector<Tolerance> read_tolerances(const std::string& path) {
  CsvReader reader = CsvReader::from_file(path);
  reader.next(); // headings
  std::vector<Tolerance> tolerances;
  while (const auto row = reader.next()) {
    reader.expect_columns(*row, 6);
    tolerances.push_back({std::string(row->cells[0]), std::string(row->cells[1]),
                          reader.number(*row, 2, "relative", Range{.low = 0}),
                          reader.number(*row, 3, "absolute", Range{.low = 0}),
                          reader.number(*row, 4, "times_uncertainty", Range{.low = 0})});
  }
  return tolerances;
}

/// A number, or nothing where the cell is empty or a text.
std::optional<double> number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

/// What may differ in one row.
double allowed_difference(const Tolerance& tolerance, const Table& kept, std::size_t row, double value) {
  double allowed = std::max(tolerance.relative * std::abs(value), tolerance.absolute);
  if (const auto uncertainty = kept.column(tolerance.column + "_uncertainty"))
    if (const auto known = number(kept.rows[row][*uncertainty]))
      allowed = std::max(allowed, tolerance.times_uncertainty * *known);
  return allowed;
}

/// Prints what is not within the tolerance; returns how many numbers were compared, and how many of them are beyond.
struct Comparison {
  int compared = 0, beyond = 0;
};
Comparison compare(const Tolerance& tolerance, const Table& kept, const Table& found) {
  const auto in_kept = kept.column(tolerance.column), in_found = found.column(tolerance.column);
  if (!in_kept || !in_found)
    throw InputError(
        fmt::format("{}: no column '{}' in the {} table", tolerance.table, tolerance.column, in_kept ? "new" : "kept"));
  Comparison result;
  const auto differs = [&](std::size_t row, const std::string& was, const std::string& is, double allowed) {
    ++result.beyond;
    fmt::print("{}: {}, row {}: found {}, kept {}, allowed to differ by {:.3g}\n", tolerance.table, tolerance.column,
               row + 1, is, was, allowed);
  };
  if (kept.rows.size() != found.rows.size()) {
    differs(0, fmt::format("{} rows", kept.rows.size()), fmt::format("{} rows", found.rows.size()), 0);
    return result;
  }
  for (std::size_t row = 0; row < kept.rows.size(); ++row) {
    const std::string &was = kept.rows[row].at(*in_kept), &is = found.rows[row].at(*in_found);
    const auto a = number(was), b = number(is);
    ++result.compared;
    if (a.has_value() != b.has_value() || (!a && was != is)) {
      differs(row, was, is, 0);
    } else if (a) {
      const double allowed = allowed_difference(tolerance, kept, row, *a);
      if (!(std::abs(*b - *a) <= allowed)) differs(row, was, is, allowed);
    }
  }
  return result;
}

int body(int argc, char** argv) {
  if (argc != 4) throw InputError("compare-numbers: allowed: TOLERANCES KEPT FOUND");
  const std::string kept = argv[2], found = argv[3];
  Comparison total;
  for (const Tolerance& tolerance : read_tolerances(argv[1])) {
    const Comparison one =
        compare(tolerance, read_table(kept + "/" + tolerance.table), read_table(found + "/" + tolerance.table));
    total.compared += one.compared;
    total.beyond += one.beyond;
  }
  fmt::print("{} numbers compared, {} beyond their tolerance\n", total.compared, total.beyond);
  return total.beyond == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
  return mpfem::run_program("compare-numbers", body, argc, argv);
}
