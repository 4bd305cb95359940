#pragma once
// Ringing: how far vibration moves single rows of a curve off what it would be at rest.

#include <vector>

#include "postproc/stages.hpp"

namespace mpfem {

/// The rows by which the ringing at `row` is judged, of a curve of so many rows.
RowRange ringing_rows(std::size_t row, std::size_t rows);

/// Twice the scatter of a column's rows about parabolas twice as wide as the smoothing's, near `row`, in the column's
/// unit: 95 % of what ringing adds to a row.
double ringing(const std::vector<double>& column, std::size_t row);

} // namespace mpfem
