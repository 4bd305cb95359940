#pragma once
// Where the ticks of a scale stand.

#include <utility>
#include <vector>

namespace mpfem {

/// A distance between ticks of 1, 2 or 5 times a power of ten, so that `most` of them fit.
double tick_distance(std::pair<double, double> range, int most);

/// The multiples of this distance within the range: at most `most` + 1; none may lie inside where few are wanted.
std::vector<double> round_ticks(std::pair<double, double> range, int most);

} // namespace mpfem
