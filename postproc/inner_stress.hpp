#pragma once
// Mean stress of the inner part of a packing, away from the walls: next to them grains lie in layers, and where six
// grains fill the box's width most of what its walls carry belongs to that layer.

#include "postproc/measurement.hpp"

namespace mpfem {

/// Of a snapshot (numbered as in snapshot_name), for the inner `share` of the box's lengths: the mean stress by Love
/// and Weber, its components and q, that of the solid, and what the walls carry. Uncertainty: half of the 95 % interval
/// of the mean of the region's eight octants, taken as independent: what another packing would differ by. Throws
/// InputError.
Measurement measure_inner_stress(const schema::FileReader& file, int snapshot, double share);

} // namespace mpfem
