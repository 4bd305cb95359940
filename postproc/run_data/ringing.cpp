#include "postproc/run_data/ringing.hpp"

#include <algorithm>
#include <cmath>

#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/smoothing.hpp"

namespace mpfem {

namespace {

/// Rows on either side for parabolas twice as wide as those of the smoothing. They show ringing with a period so long
/// that the narrow ones follow it.
std::size_t wide_half_rows(std::size_t rows) {
  const std::size_t half = smoothing_half_rows(rows);
  return rows > 4 * half ? 2 * half : half;
}

} // namespace

RowRange ringing_rows(std::size_t row, std::size_t rows) {
  const std::size_t wide = wide_half_rows(rows);
  return {row > wide ? row - wide : 0, std::min(row + wide, rows - 1)};
}

double ringing(const std::vector<double>& column, std::size_t row) {
  const RowRange rows = ringing_rows(row, column.size());
  const std::vector<double> smooth = local_parabolas(column, wide_half_rows(column.size()));
  double squares = 0;
  for (std::size_t i = rows.first; i <= rows.last; ++i) squares += (column[i] - smooth[i]) * (column[i] - smooth[i]);
  // A parabola takes three of the rows' degrees of freedom.
  return 2 * std::sqrt(squares / std::max(1.0, static_cast<double>(rows.count()) - 3));
}

} // namespace mpfem
