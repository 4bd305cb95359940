#pragma once
// Strength of a compact: unconfined or triaxial.

#include <optional>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

/// Whether the lateral walls carry load.
enum class StrengthTest { unconfined, triaxial };
/// Which point of the curve is the strength.
enum class StrengthCriterion {
  peak,        ///< unconfined: largest axial stress; triaxial: peak of q, otherwise q at a given strain
  damage_onset ///< axial stress (triaxial: q) where damage begins to grow
};

/// How a strength is read.
struct StrengthRule {
  std::optional<StrengthTest> test; ///< default: by the stage's type, otherwise by whether the lateral walls carry load
  StrengthCriterion criterion = StrengthCriterion::peak;
  double drop = 0.02;      ///< share of its value by which the smoothed curve must fall after a peak
  double at_strain = 0.15; ///< axial strain at which q is read if there is no peak by then
};

/// Strength (MPa) from curves smoothed by smoothing.hpp. Unconfined: the paper uses the axial stress at failure, which
/// coincides with the onset of damage (Section 4.2, Fig. 15). Triaxial: q at its peak, or without a peak at an axial
/// strain of 15 % (Section 4.3). Uncertainty of every stress: twice the scatter of the rows about parabolas of twice
/// the width, which covers the amplitude of ringing; at the onset of damage also the effect of its strain's
/// uncertainty. Throws InputError where the stage is too short, is not an axial compression, or does not reach the
/// strain.
Measurement strength(const StageCurve& curve, const StrengthRule& rule);

/// Strength in stage `number` (default: the last unconfined_compression or triaxial_compression, otherwise the last
/// stage), for unconfined tests with add_true_stress. Throws InputError.
Measurement measure_strength(const schema::FileReader& file, std::optional<int> number, const StrengthRule& rule);

} // namespace mpfem
