#include "postproc/metrics/janssen.hpp"

#include <cmath>

namespace mpfem {

double mean_axial_stress_in_die(const DieSlice& slice) {
  // log1p of the small difference keeps the mean accurate for nearly equal stresses.
  const double difference = slice.upper_stress - slice.lower_stress;
  const double logarithm = std::log1p(difference / slice.lower_stress);
  return logarithm != 0 ? difference / logarithm : slice.lower_stress;
}

double wall_friction(const DieSlice& slice, double mean_radial_stress) {
  return slice.diameter * (slice.upper_stress - slice.lower_stress) / (4 * slice.height * mean_radial_stress);
}

} // namespace mpfem
