#include "solver/run/bond_programme.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "common/csv_reader.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "common/table_reader.hpp"
#include "solver/scenario/ranges.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

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

/// A point on the straight line between two separations; exact at both ends.
Separation between(const Separation& from, const Separation& to, int part, int parts) {
  if (part == parts) return to;
  const double t = static_cast<double>(part) / parts;
  return {from.opening + t * (to.opening - from.opening), from.shear1 + t * (to.shear1 - from.shear1),
          from.shear2 + t * (to.shear2 - from.shear2)};
}

/// Work of the tractions from one separation to the next by the trapezoidal rule, N/mm.
double trapezoid(const Separation& a, const BondedPoint::Response& at_a, const Separation& b,
                 const BondedPoint::Response& at_b) {
  return 0.5 *
         ((at_a.normal + at_b.normal) * (b.opening - a.opening) + (at_a.shear1 + at_b.shear1) * (b.shear1 - a.shear1) +
          (at_a.shear2 + at_b.shear2) * (b.shear2 - a.shear2));
}

void refuse_overwriting(const std::string& output, const std::string& input) {
  std::error_code ignored; // if a file does not exist, they differ
  if (std::filesystem::equivalent(output, input, ignored))
    throw InputError(fmt::format("{}: is an input; allowed: another --output", shown_path(output)));
}

} // namespace

BondedPoint::Response BondedPoint::move_to(const Separation& separation) {
  const BondLaw& law = law_.bond;
  const bool closed = separation.opening < 0;
  if (closed && gone_) {
    dissipated_before_ += law.fracture_energy;
    state_ = {};
    attached_ = separation;
    gone_ = false;
  }
  const double shear1 = separation.shear1 - attached_.shear1, shear2 = separation.shear2 - attached_.shear2;
  const BondTraction traction = bond_traction(law, state_, separation.opening, shear1, shear2);
  const bool broken = is_broken(law, state_);
  gone_ = law_.rebond_on_contact && broken && !closed;

  Response response;
  const double penetration = closed ? separation.opening : 0.0;
  response.normal = traction.normal + law_.penalty * penetration;
  response.shear1 = traction.shear[0];
  response.shear2 = traction.shear[1];
  const double open = closed ? 0.0 : separation.opening;
  response.effective = law.normal_only ? open : std::sqrt(open * open + shear1 * shear1 + shear2 * shear2);
  response.damage = 1 - remaining_stiffness(law, state_);
  response.stored = traction.stored + 0.5 * law_.penalty * penetration * penetration;
  response.dissipated = dissipated_before_ + damage_dissipation(law, state_);
  response.state = broken ? "broken" : state_.initiation > 0 ? "damaged" : "intact";
  return response;
}

BondedPointLaw read_bonded_point_law(const TomlDocument& document) {
  TableReader root(document);
  const double penalty = root.number("stiffness", positive_stiffness);
  TableReader table = root.table("bond");
  const BondParameters bond = read_bond(table);
  root.finish();
  if (bond.stiffness_factor) table.fail("stiffness_factor", "is used only with a mesh; allowed: 'stiffness' (MPa/mm)");
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

namespace {

/// The table of results while it is written, and a summary of where it ended.
class BondTable {
public:
  BondTable(const std::string& path, const BondedPointLaw& law)
      : file_(path), point_(law), response_(point_.move_to(here_)) {
    fmt::format_to(
        std::back_inserter(text_),
        "way_point,opening_mm,shear1_mm,shear2_mm,normal_traction_MPa,shear1_traction_MPa,shear2_traction_MPa,"
        "effective_separation_mm,damage,stored_N_per_mm,dissipated_N_per_mm,work_N_per_mm,"
        "trapezoidal_work_N_per_mm,state\n");
    write_row(0);
  }

  /// Walks to a way point, with a row for each increment.
  void walk_to(const WayPoint& way_point, std::size_t number) {
    const Separation from = here_;
    for (int k = 1; k <= way_point.increments; ++k) {
      const Separation next = between(from, way_point.separation, k, way_point.increments);
      const BondedPoint::Response there = point_.move_to(next);
      work_ += trapezoid(here_, response_, next, there);
      here_ = next;
      response_ = there;
      peak_normal_ = std::max(peak_normal_, response_.normal);
      peak_shear_ = std::max(peak_shear_, std::hypot(response_.shear1, response_.shear2));
      write_row(number);
    }
  }

  void complete() {
    write_out();
    file_.complete();
  }

  std::string summary() const {
    return fmt::format("{} at the end, damage {:.6g}; largest traction {:.6g} MPa in tension, {:.6g} MPa in shear; "
                       "dissipated {:.6g} N/mm, stored {:.6g} N/mm",
                       response_.state, response_.damage, peak_normal_, peak_shear_, response_.dissipated,
                       response_.stored);
  }

private:
  void write_row(std::size_t way_point) {
    constexpr std::size_t buffered = 1 << 16; // bytes
    const BondedPoint::Response& r = response_;
    fmt::format_to(std::back_inserter(text_), "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", way_point, here_.opening,
                   here_.shear1, here_.shear2, r.normal, r.shear1, r.shear2, r.effective, r.damage, r.stored,
                   r.dissipated, r.stored + r.dissipated, work_, r.state);
    if (text_.size() > buffered) write_out();
  }
  void write_out() {
    file_.write({text_.data(), text_.size()});
    text_.clear();
  }

  TextFile file_;
  fmt::memory_buffer text_;
  BondedPoint point_;
  Separation here_;
  BondedPoint::Response response_;
  double work_ = 0, peak_normal_ = 0, peak_shear_ = 0;
};

} // namespace

void run_bond_programme(const BondProgrammeOptions& options) {
  TomlDocument document = TomlDocument::from_file(options.law);
  for (const std::string& assignment : options.assignments) document.set(assignment);
  const BondedPointLaw law = read_bonded_point_law(document);
  const std::vector<WayPoint> programme = read_bond_programme(options.programme, options.increments);
  check_output_path("--output", options.output, OutputKind::text);
  refuse_overwriting(options.output, options.law);
  refuse_overwriting(options.output, options.programme);

  BondTable table(options.output, law);
  for (std::size_t i = 0; i < programme.size(); ++i) table.walk_to(programme[i], i + 1);
  table.complete();
  if (!options.quiet) fmt::print("{}: {}\n", one_line(options.output), table.summary());
}

} // namespace mpfem
