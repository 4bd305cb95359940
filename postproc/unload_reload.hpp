#pragma once
// Young's modulus of a compact from a small loop of unloading and reloading: elastic, whatever the loading itself does.

#include <optional>

#include "postproc/measurement.hpp"
#include "postproc/stage_curve.hpp"

namespace mpfem {

/// Rows of a curve at which a loop turns: the axial strain rises to `top`, falls to `bottom`, and rises again to
/// `closed`, the first row at which stress or strain is back at what it was at the top, else the last.
struct UnloadReloadLoop {
  std::size_t top = 0, bottom = 0, closed = 0;
};

/// All loops of a curve, in order. Strains are the box's: they do not ring, and every reversal is one of the walls.
std::vector<UnloadReloadLoop> unload_reload_loops(const StageCurve& curve);

/// Unload-reload modulus (MPa) of loop `number` (from 0; negative from the end): the mean of the slopes of its two
/// branches by Theil and Sen. In a loop without ringing that is the line through the points at which it turns, by which
/// pressuremeter and triaxial tests are read (ISO 22476-4), and which is given as well. Also the loop's area and what
/// was dissipated in it. Uncertainty: half of the 95 % interval of the mean, and half of the difference of both slopes,
/// as hypotenuse. Throws InputError where there is no such loop.
Measurement unload_reload_modulus(const StageCurve& curve, int number);

/// Of the stages of one type that follow each other, stage `number` among them (default: the last
/// unconfined_compression, else the last stage). Throws InputError.
Measurement measure_unload_reload_modulus(const schema::FileReader& file, std::optional<int> number, int loop);

} // namespace mpfem
