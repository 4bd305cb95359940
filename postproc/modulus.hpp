#pragma once
// Young's modulus of a compact from axial reloading.

#include <array>
#include <optional>

#include "postproc/measurement.hpp"
#include "postproc/stage_curve.hpp"

namespace mpfem {

struct ModulusRule {
  double slope_change = 0.05;   ///< the slopes of the window's two halves differ by no more than this share of its own
  double damage_share = 0.01;   ///< damage dissipation in the window over the axial work in it, at most
  double stress_fraction = 0.5; ///< of the rise from the lowest to the highest axial stress, at most
  std::optional<std::array<double, 2>> strain_range; ///< a window given by hand, axial strain since the stage began
};

/// Slope of axial stress against axial strain at the beginning of the reloading (the paper's E_p, Section 4.2), MPa, by
/// Theil and Sen. The window begins where the (smoothed) axial stress is lowest before its peak, and is the longest
/// one, of seven rows or more, that meets the rule; the shortest, with a note, where none does. Where the slope still
/// grows over the first fifth of the rise, by more than the rule allows and two standard deviations, that toe is left
/// out with a note: the window begins at the first row from which it meets the rule over a fifth of the rise.
/// Uncertainty: half of the 95 % interval of the slope, and the difference of the halves' slopes: on a curve that bends
/// evenly the slope at the window's beginning differs from the window's by as much.
/// Throws InputError where the stage has too few rows, or its axial stress does not rise with the axial strain.
Measurement modulus(const StageCurve& curve, const ModulusRule& rule);

/// Of stage `number` (default: the last unconfined_compression, else the last stage), also over the grains' modulus:
/// the scenario's, or `youngs_modulus` in MPa where it is given.
Measurement measure_modulus(const schema::FileReader& file, std::optional<int> number, const ModulusRule& rule,
                            std::optional<double> youngs_modulus);

} // namespace mpfem
