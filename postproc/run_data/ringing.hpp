#pragma once
// Ringing: how far vibration moves single rows of a curve from their static values.

#include <vector>

#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// The rows from which the ringing at `row` is estimated, in a curve of `rows` rows.
RowRange ringing_rows(std::size_t row, std::size_t rows);

/// 95 % of what ringing adds to a row, in the column's unit: twice the scatter of the column's rows near `row` about
/// parabolas that are twice as wide as those of the smoothing.
double ringing(const std::vector<double>& column, std::size_t row);

} // namespace mpfem
