#pragma once
// The packing as stages see it: a block of soft material in a cell.

#include "solver/boundary/cell.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// A compact's modulus over that of its grains, as stages assume it beforehand. Compacts of the powders of Table 1 lie
/// between 0.05 (barely jammed) and 0.5. Held walls follow softer compacts with a little less damping, stiffer ones a
/// little more slowly.
inline constexpr double compact_modulus = 0.1;

/// Properties of the packing from which stages derive speeds and gains.
struct Sample {
  double mass = 0;                ///< tonne, as scaled
  double solid_volume = 0;        ///< mm^3, of all grains at the start
  double constrained_modulus = 0; ///< MPa, K + 4 G/3 of the grains, the mean over their volumes
  double contact_stiffness = 0;   ///< MPa/mm, the largest penalty of a grain
};
/// The sample that all grains of the packing form, own or not.
Sample sample_of(const Model& model);

/// s, in which waves cross the longest side of a cell: in a compact that is a tenth as stiff as its grains.
double wave_transit(const Sample& sample, const Cell& cell);

} // namespace mpfem
