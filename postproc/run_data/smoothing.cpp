#include "postproc/run_data/smoothing.hpp"

#include <algorithm>

#include "postproc/fits/statistics.hpp"

namespace mpfem {

std::size_t smoothing_half_rows(std::size_t rows) {
  return std::max<std::size_t>(3, (2 * rows + 50) / 100);
}

std::vector<double> smoothed(std::span<const double> values) {
  return local_parabolas(values, smoothing_half_rows(values.size()));
}

} // namespace mpfem
