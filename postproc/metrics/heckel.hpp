#pragma once
// Heckel's law of compaction and its mean yield pressure.

#include <array>
#include <optional>
#include <span>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Which rows may form the window.
struct HeckelRule {
  double r_squared = 0.999;      ///< smallest coefficient of determination allowed in the window
  double largest_density = 0.98; ///< rows with a larger relative density are left out
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
/// upper punch, D the relative density, below 1. Uncertainty of P_y, in quadrature: half of the 95 % interval from the
/// slope, widened by sqrt((1 + r) / (1 - r)) for residuals with a lag-1 correlation r, and half of the difference of
/// P_y between the two halves of the rows. Uncertainty of A: half of its interval, widened in the same way. Empty where
/// D does not grow with P. Needs four rows.
std::optional<HeckelFit> heckel_line(std::span<const double> pressure, std::span<const double> density, RowRange rows);

/// The window over the largest range of pressure in which the line has the rule's R^2. Rows beyond the largest
/// pressure, without pressure, or denser than the rule allows do not belong to it. Empty where no window has enough
/// rows.
std::optional<HeckelFit> heckel_window(std::span<const double> pressure, std::span<const double> density,
                                       const HeckelRule& rule);

/// D corrected for the solid's elastic compression: D / (1 + P / K), K the solid's bulk modulus (MPa). Under load a
/// compact is denser than its pores alone make it, so that the uncorrected P_y is too small.
double density_without_elastic_compression(double density, double pressure, double bulk_modulus);

/// In-die, from the curve of one stage of a run: P the stress of the upper punch, D the history's relative density. The
/// value is P_y (MPa). The details also hold P_y, over the same rows, of the relative density by the grains' present
/// volumes and, with a bulk modulus (MPa) of the solid, of D corrected for elastic compression. Throws InputError where
/// no window meets the rule.
Measurement measure_heckel(const schema::FileReader& file, const StageRows& stage, const HistoryTable& history,
                           const HeckelRule& rule, std::optional<double> bulk_modulus);

} // namespace mpfem
