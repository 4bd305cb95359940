#pragma once
// The rule by which curves are smoothed against ringing before a peak is read from them.

#include <span>
#include <vector>

namespace mpfem {

/// Rows on either side of a row to which its parabola is fitted: 2 % of all rows, at least three.
std::size_t smoothing_half_rows(std::size_t rows);

/// local_parabolas with smoothing_half_rows. Needs seven values or more.
std::vector<double> smoothed(std::span<const double> values);

} // namespace mpfem
