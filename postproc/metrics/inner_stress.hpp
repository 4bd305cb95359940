#pragma once
// Mean stress of the inner part of a packing, away from the walls. Grains lie in layers next to walls; in a box six
// grains wide, that layer accounts for most of what the walls carry.

#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// Mean stress (MPa) by Love and Weber of a snapshot (numbered as in snapshot_name), over the inner `share` (0 … 1) of
/// the box's lengths. The details hold its components and q, the mean stress of the solid, and what the walls carry.
/// Uncertainty: half of the 95 % interval of the mean of the region's eight octants, taken as independent; it covers
/// the difference to other packings. Throws InputError.
Measurement measure_inner_stress(const schema::FileReader& file, int snapshot, double share);

} // namespace mpfem
