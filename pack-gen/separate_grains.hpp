#pragma once
// Turning grains' meshes until no two of them touch.

#include <functional>

#include "pack-gen/grain_mesh.hpp"

namespace mpfem {

/// Writes the nodes of a grain in its orientation number `attempt` (0, 1, …) to `node` [nodes of the grain * 3].
using PlaceGrain = std::function<void(std::size_t grain, int attempt, double* node)>;

/// A mesh with the exact volume of its sphere sticks out of it a little. If the hulls of two grains, or of a grain and
/// a wall, are not proven apart, grains are turned in place, one after the other, each to the best of some orientations
/// with its neighbours as they are, until all are apart. The result does not depend on the number of threads. Returns
/// how many grains were turned. Throws InputError, naming two grains, when some still touch in the end.
std::size_t separate_grains(const SpherePacking& packing, PackingMesh& mesh, double nominal_size, int threads,
                            const PlaceGrain& place);

} // namespace mpfem
