#pragma once
// Yield point of a probe of a compact, by the energy that it dissipates.

#include <optional>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

/// The first point of the stage where the total dissipation, plastic and damage, reaches `ratio` times its value at the
/// stage's beginning, which is the end of the unloading (paper, Section 4.4, after Schmidt et al.: 1.003); linear
/// between rows. The value is q (MPa); p is in the details. Uncertainty, in quadrature: half of the change between the
/// two rows, and the rows' ringing over the stage (95 %). Throws InputError where nothing was dissipated before, or the
/// ratio is not reached.
Measurement yield_point(const StageCurve& curve, double ratio);

/// yield_point of stage `number` (default: the last probe, otherwise the last stage). Throws InputError.
Measurement measure_yield(const schema::FileReader& file, std::optional<int> number, double ratio);

} // namespace mpfem
