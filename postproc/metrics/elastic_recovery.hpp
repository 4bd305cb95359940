#pragma once
// How far a compact springs back when it is unloaded.

#include <span>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// The recovery by Eq. 9, and the numbers that it is computed from.
struct ElasticRecovery {
  double largest_density = 0, smallest_density = 0;  ///< D_max in the densest row, D_min in the last
  double stress_at_largest = 0, residual_stress = 0; ///< MPa, mean stress in those rows
  double recovery = 0;                    ///< Eq. 9: (D_max - D_min) / D_max, relative to the unloaded volume
  double recovery_over_loaded_volume = 0; ///< R / (1 - R) = (D_max - D_min) / D_min
  double recovery_at_zero_stress = 0;     ///< with D_min extrapolated to zero mean stress
  double uncertainty = 0;                 ///< of the recovery; NaN where it is not known
  /// Of recovery_at_zero_stress: the difference of both extrapolations, plus the effect of ringing.
  double uncertainty_at_zero_stress = 0;
  std::size_t densest_row = 0, extrapolated_from_row = 0; ///< row numbers in the spans
};

/// Eq. 9 of Ku, Zhao, Mollon and Zhao. `density` and `mean_stress` (MPa) hold loading and unloading, row by row, up to
/// the end of the unloading. The recovery at zero stress comes from a line of density over stress through the last rows
/// (at least five, and all with at most three times the residual stress). The uncertainty is the sum of: the recovery
/// that the residual stress still holds back, by that line or by one over p^(2/3) (contacts that open as in Hertz's
/// theory), the larger of both; half of the 95 % interval of the density at zero stress, by the line that fits better;
/// and the distance of the last row from that line. Throws InputError naming `path` where nothing is unloaded.
ElasticRecovery elastic_recovery(std::span<const double> density, std::span<const double> mean_stress,
                                 const std::string& path);

/// Elastic recovery in the unloading stage `number` (default: choose_unloading); the loading is the stage before it.
/// Throws InputError.
Measurement measure_elastic_recovery(const schema::FileReader& file, std::optional<int> number);

} // namespace mpfem
