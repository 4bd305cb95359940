#pragma once
// Heckel's law of compaction, and the mean yield pressure that it gives.

#include <array>
#include <optional>
#include <span>

#include "postproc/measurement.hpp"
#include "postproc/stages.hpp"

namespace mpfem {

struct HeckelRule {
  double r_squared = 0.999;      ///< least coefficient of determination in the window
  double largest_density = 0.98; ///< rows of a larger relative density are left out
  std::size_t fewest_rows = 7;
};

/// A line ln 1/(1 - D) = P / P_y + A through rows first … last, both included.
struct HeckelFit {
  std::size_t first = 0, last = 0;
  double yield_pressure = 0, yield_pressure_uncertainty = 0; ///< MPa, P_y
  double intercept = 0, intercept_uncertainty = 0;           ///< 1, A
  double r_squared = 0;
};

/// Heckel (Trans. Metall. Soc. AIME 221, 671 and 1001, 1961) through all of these rows: P (MPa) the pressure of the
/// upper punch, D the relative density, below 1. Uncertainty of P_y: half of the slope's 95 % interval, widened by
/// sqrt((1 + r) / (1 - r)) for residuals with a lag-1 correlation r, and half of the difference of P_y between the two
/// halves of the rows, as the sides of a right angle; of A: half of its interval, widened alike. Nothing where D does
/// not grow with P. Needs four rows.
std::optional<HeckelFit> heckel_line(std::span<const double> pressure, std::span<const double> density, RowRange rows);

/// The longest window, by pressure, in which the line has the rule's R^2; rows beyond the largest pressure, without
/// pressure, or denser than the rule allows belong to none. Nothing where no window has so many rows.
std::optional<HeckelFit> heckel_window(std::span<const double> pressure, std::span<const double> density,
                                       const HeckelRule& rule);

/// D less the solid's elastic compression: D / (1 + P / K), K the solid's bulk modulus (MPa). Under load a compact is
/// denser than its pores alone make it, and P_y is read too small.
double density_without_elastic_compression(double density, double pressure, double bulk_modulus);

/// In-die, from the curve of one stage of a run: P the stress of the upper punch, D the history's relative density. The
/// value is P_y (MPa). With a bulk modulus (MPa) of the solid also P_y of D without elastic compression, in the same
/// rows; without one that of the grains' present volumes, which the history has. Throws InputError.
Measurement measure_heckel(const schema::FileReader& file, const StageRows& stage, const HistoryTable& history,
                           const HeckelRule& rule, std::optional<double> bulk_modulus);

} // namespace mpfem
