#pragma once
// Young's modulus of a compact from axial reloading.

#include <array>
#include <optional>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

/// Limits of the window in which the slope is read.
struct ModulusRule {
  double slope_change = 0.05;   ///< the slopes of the window's halves differ by no more than this share of its slope
  double damage_share = 0.01;   ///< largest damage dissipation over axial work in the window
  double stress_fraction = 0.5; ///< largest share of the rise from lowest to highest axial stress
  std::optional<std::array<double, 2>> strain_range; ///< a window given by hand: axial strain since the stage began
};

/// Theil-Sen slope of axial stress against axial strain at the beginning of the reloading (the paper's E_p, Section
/// 4.2), MPa. The window begins where the (smoothed) axial stress is lowest before its peak. It is the longest one, of
/// seven rows or more, that meets the rule; if none does, the shortest one, with a note. A toe is left out with a note:
/// it is there if the slope still grows over the first fifth of the rise, by more than the rule allows plus two
/// standard deviations. The window then begins at the first row from which it meets the rule over a fifth of the rise.
/// Uncertainty, in quadrature: half of the 95 % interval of the slope, and the difference of the halves' slopes,
/// because on an evenly bent curve the slope at the window's beginning differs from the window's by as much.
/// Throws InputError where the stage has too few rows, or its axial stress does not rise with the axial strain.
Measurement modulus(const StageCurve& curve, const ModulusRule& rule);

/// The modulus in stage `number` (default: the last unconfined_compression, otherwise the last stage). The details also
/// hold it over that of the grains: `youngs_modulus` (MPa) where given, otherwise the scenario's. Throws InputError.
Measurement measure_modulus(const schema::FileReader& file, std::optional<int> number, const ModulusRule& rule,
                            std::optional<double> youngs_modulus);

} // namespace mpfem
