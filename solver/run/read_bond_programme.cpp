#include "solver/run/read_bond_programme.hpp"

#include <string_view>

#include <fmt/format.h>

#include "common/csv_reader.hpp"
#include "common/one_line.hpp"
#include "common/table_reader.hpp"
#include "solver/scenario/ranges.hpp"
#include "solver/scenario/read_bond.hpp"

namespace mpfem {

BondedPointLaw read_bonded_point_law(const TomlDocument& document) {
  TableReader root(document);
  const double penalty = root.number("stiffness", positive_stiffness);
  TableReader table = root.table("bond");
  const BondParameters bond = read_bond(table);
  root.finish();
  if (bond.stiffness_factor) table.fail("stiffness_factor", "is used only with a mesh, allowed: 'stiffness' (MPa/mm)");
  const BondLaw law{.stiffness = bond.stiffness.value_or(penalty),
                    .tensile_strength = bond.tensile_strength,
                    .shear_strength = bond.shear_strength,
                    .fracture_energy = bond.fracture_energy,
                    .softening = bond.softening,
                    .normal_only = bond.normal_only};
  if (const double smallest = smallest_fracture_energy(law); !(law.fracture_energy > smallest)) // as in a run
    table.fail("fracture_energy", fmt::format("found {:g} N/mm, allowed: > {:.3g} N/mm (1.01 strength^2/(2 stiffness))",
                                              law.fracture_energy, smallest));
  return {law, penalty, bond.rebond_on_contact};
}

namespace {

constexpr std::string_view heading = "opening,shear1,shear2[,increments]";
constexpr const char* column_names[] = {"opening", "shear1", "shear2", "increments"};
constexpr Range separations = Range::between(-1e6, 1e6); // mm; their squares are far from overflow
constexpr long long most_increments = 10'000'000;
constexpr Range increment_numbers = Range::between(1, most_increments);

void check_heading(const CsvReader& reader, const CsvRow& row) {
  if (row.cells.size() < 3 || row.cells.size() > 4)
    reader.fail(row, fmt::format("found a heading of {} columns, allowed: {}", row.cells.size(), heading));
  for (std::size_t i = 0; i < row.cells.size(); ++i)
    if (row.cells[i] != column_names[i])
      reader.fail(row, fmt::format("column {}: found the heading '{}', allowed: {}", column_names[i],
                                   shortened(row.cells[i]), heading));
}

} // namespace

std::vector<WayPoint> read_bond_programme(CsvReader reader, int increments) {
  const auto names = reader.next();
  if (!names) reader.fail(CsvRow{1, {}}, fmt::format("found no heading, allowed: {}", heading));
  check_heading(reader, *names);
  const std::size_t columns = names->cells.size();
  std::vector<WayPoint> way_points;
  long long total = 0;
  while (const auto row = reader.next()) {
    if (row->cells.size() != columns)
      reader.fail(*row, fmt::format("found {} columns, allowed: {} as in the heading", row->cells.size(), columns));
    const auto separation = [&](std::size_t i) { return reader.number(*row, i, column_names[i], separations); };
    WayPoint way_point{{separation(0), separation(1), separation(2)}, increments};
    if (columns == 4 && !row->cells[3].empty())
      way_point.increments = static_cast<int>(reader.integer(*row, 3, column_names[3], increment_numbers));
    total += way_point.increments;
    if (total > most_increments)
      reader.fail(*row,
                  fmt::format("column increments: found {} up to here, allowed: {} in all", total, most_increments));
    way_points.push_back(way_point);
  }
  if (way_points.empty()) reader.fail("found no row below the heading, allowed: rows of separations to reach");
  return way_points;
}

std::vector<WayPoint> read_bond_programme(const std::string& path, int increments) {
  return read_bond_programme(CsvReader::from_file(path), increments);
}

} // namespace mpfem
