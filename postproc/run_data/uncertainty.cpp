#include "postproc/run_data/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mpfem {

namespace {

constexpr std::size_t window = 7;      // as the narrowest parabolas of smoothing.hpp
constexpr std::size_t fewest_rows = 4; // a parabola takes three, which leaves one for the scatter

bool is_of_bonds(std::string_view energy) {
  return energy == "damage_dissipation" || energy == "bond_energy";
}

} // namespace

RowRange rows_about(std::size_t row, RowRange allowed) {
  const std::size_t rows = std::min(window, allowed.count());
  const std::size_t before = std::min(row - allowed.first, rows / 2);
  const std::size_t first = std::min(row - before, allowed.last + 1 - rows);
  return {first, first + rows - 1};
}

double row_uncertainty(std::span<const double> x, std::span<const double> y) {
  if (x.size() < fewest_rows) return std::numeric_limits<double>::quiet_NaN();
  const Parabola parabola = least_squares_parabola(x, y);
  return student_t_95(parabola.freedom) * parabola.scatter;
}

double row_uncertainty(const HistoryTable& history, std::span<const double> column, std::size_t row, RowRange allowed) {
  const RowRange rows = rows_about(row, allowed);
  return row_uncertainty(rows.of(history["time"]), rows.of(column));
}

double interpolation_uncertainty(std::span<const double> x, std::span<const double> y, Crossing at, double target,
                                 RowRange allowed) {
  const RowRange rows = rows_about(at.row, allowed);
  if (rows.count() < fewest_rows) return at.half_spacing(y);
  const double noise = std::hypot(at.fraction, 1 - at.fraction) * row_uncertainty(rows.of(x), rows.of(y));
  return std::hypot(noise, at.of(y) - least_squares_parabola(rows.of(x), rows.of(y)).at(target));
}

double turning_point_uncertainty(std::span<const double> column, std::size_t row) {
  const double before = row > 0 ? std::abs(column[row] - column[row - 1]) : 0.0;
  const double after = row + 1 < column.size() ? std::abs(column[row + 1] - column[row]) : 0.0;
  return 0.5 * std::max(before, after);
}

double energy_uncertainty(const HistoryTable& history, std::string_view energy, std::size_t row, RowRange stage) {
  const double scatter = row_uncertainty(history, history[energy], row, stage);
  return is_of_bonds(energy) ? scatter : std::hypot(scatter, history["energy_residual"][row]);
}

double energy_change_uncertainty(const HistoryTable& history, std::string_view energy, RowRange stage) {
  const auto& residual = history["energy_residual"];
  const auto of_row = [&](std::size_t row) { return row_uncertainty(history, history[energy], row, stage); };
  const double unbalanced = is_of_bonds(energy) ? 0.0 : residual[stage.last] - residual[stage.first];
  return std::hypot(of_row(stage.first), of_row(stage.last), unbalanced);
}

void note_short_stage(Measurement& m, RowRange stage) {
  if (stage.count() < fewest_rows)
    m.notes.push_back(
        fmt::format("the stage has {} rows, needed for the scatter of its rows: {}; uncertainties are not known",
                    stage.count(), fewest_rows));
}

} // namespace mpfem
