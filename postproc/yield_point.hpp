#pragma once
// Where a probe of a compact begins to yield, by the energy that it dissipates.

#include <optional>

#include "postproc/measurement.hpp"
#include "postproc/stage_curve.hpp"

namespace mpfem {

/// The first point of the stage where the total dissipation, plastic and damage, has reached `ratio` times its value at
/// the stage's beginning, the end of the unloading (paper, Section 4.4, after Schmidt et al.: 1.003), by linear
/// interpolation between rows. The value is q; p is in the details. Uncertainty: half of the change between the rows on
/// both sides. Throws InputError where nothing was dissipated before, or the ratio is not reached.
Measurement yield_point(const StageCurve& curve, double ratio);

/// Of stage `number` (default: the last probe, else the last stage).
Measurement measure_yield(const schema::FileReader& file, std::optional<int> number, double ratio);

} // namespace mpfem
