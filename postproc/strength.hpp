#pragma once
// Strength of a compact: unconfined or triaxial.

#include <optional>

#include "postproc/measurement.hpp"
#include "postproc/stage_curve.hpp"

namespace mpfem {

enum class StrengthTest { unconfined, triaxial };
enum class StrengthCriterion {
  peak,        ///< unconfined: largest axial stress; triaxial: peak of q, else q at a given strain
  damage_onset ///< axial stress (triaxial: q) where damage begins to grow
};

struct StrengthRule {
  std::optional<StrengthTest> test; ///< default: as the stage's type says, else as the lateral walls carry load or not
  StrengthCriterion criterion = StrengthCriterion::peak;
  double drop = 0.02;      ///< share of the peak by which the smoothed curve must fall after it for it to be a peak
  double at_strain = 0.15; ///< axial strain at which q is read where there is no peak by then
};

/// From curves smoothed as smoothing.hpp says. Unconfined: the paper takes the axial stress at failure, which coincides
/// with the onset of damage (Section 4.2, Fig. 15). Triaxial: q at its peak, or where it has none at an axial strain of
/// 15 % (Section 4.3). Uncertainty of every stress: twice the scatter of the rows about parabolas of twice the width,
/// which covers the amplitude of ringing; at the onset of damage also what its strain is off. Throws InputError where
/// the stage is too short or does not reach the strain.
Measurement strength(const StageCurve& curve, const StrengthRule& rule);

/// Of stage `number` (default: the last unconfined_compression or triaxial_compression, else the last stage).
Measurement measure_strength(const schema::FileReader& file, std::optional<int> number, const StrengthRule& rule);

} // namespace mpfem
