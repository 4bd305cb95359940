#pragma once
// Young's modulus of a compact from a small unload-reload loop, which is elastic even where the loading is not.

#include <optional>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

/// Rows of a curve at which a loop turns: the axial strain rises to `top`, falls to `bottom`, and rises again. `closed`
/// is the first row at which stress or strain is back at its value at the top, otherwise the last row of the reloading.
struct UnloadReloadLoop {
  std::size_t top = 0, bottom = 0, closed = 0;
};

/// All loops of a curve, in order. Strains are those of the box: they do not ring, so that every reversal is one of the
/// walls.
std::vector<UnloadReloadLoop> unload_reload_loops(const StageCurve& curve);

/// Unload-reload modulus (MPa) of loop `number` (from 0; negative from the end): the mean of the Theil-Sen slopes of
/// its two branches. In a loop without ringing it equals the slope between the turning points, by which pressuremeter
/// and triaxial tests are read (ISO 22476-4), and which is in the details. These also hold the loop's area (MPa) and
/// the energies dissipated in it (mJ). Uncertainty, in quadrature: half of the 95 % interval of the mean, and half of
/// the difference of both slopes. Throws InputError where there is no such loop.
Measurement unload_reload_modulus(const StageCurve& curve, int number);

/// Over the consecutive stages of one type that include stage `number` (default: the last unconfined_compression,
/// otherwise the last stage). Throws InputError.
Measurement measure_unload_reload_modulus(const schema::FileReader& file, std::optional<int> number, int loop);

} // namespace mpfem
