#pragma once
// The one rule by which curves are smoothed against ringing before a peak is read from them.

#include <span>
#include <vector>

namespace mpfem {

/// Rows on either side of a row that its parabola is fitted to: 2 % of all rows, three at least.
std::size_t smoothing_half_rows(std::size_t rows);

/// local_parabolas by that rule. Needs seven values or more.
std::vector<double> smoothed(std::span<const double> values);

} // namespace mpfem
