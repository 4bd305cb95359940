#pragma once
// Spheres that sink under their weight until they rest on each other and on the bottom, without friction.
//
// Method: as in packing.hpp, spheres are soft and repel each other; each is pulled down in proportion to its volume.
// The energy is minimised with FIRE, with ever smaller weights, until the overlap that carries them is within the
// margin that the gaps leave. Then nothing overlaps, and up to that margin the bed is that of hard spheres.

#include <functional>
#include <string>

#include "pack-gen/packing.hpp"

namespace mpfem {

/// How spheres are to settle.
struct SettleRequest {
  double smallest_gap = 0; ///< mm, between spheres and to the walls, kept in the bed
  bool fit_height = false; ///< lower or raise the container to the bed, a gap above its highest sphere
  std::function<void(const std::string& state)> progress{};
};

/// Spheres at rest.
struct SettledPacking {
  SpherePacking packing;
  double bed_height = 0; ///< mm, of the top of the highest sphere
  double unbalanced = 0; ///< largest force left on a sphere, over its weight
};

/// The spheres of a packing at rest under gravity along -z, order and radii kept. A box or cylinder is open above while
/// they settle. The same request gives the same bed. Throws InputError if they do not come to rest with these gaps, or
/// if the bed is higher than a container that is not fitted.
SettledPacking settle(const SpherePacking& packing, const SettleRequest& request);

} // namespace mpfem
