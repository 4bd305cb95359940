#pragma once
// What a meshed packing must be so that a model can be built from it. All of these throw InputError, with `name` for
// the file.

#include <string>

#include "solver/model/model.hpp"

namespace mpfem {

/// Sizes of the arrays, numbers of nodes, tetrahedra that are inverted or degenerate, coordinates that are not finite.
void check_packing(const MeshedPacking& packing, const std::string& name);

/// Edges of tets must be 1e-4 … 1e4 mm long where tets are in single precision: eighth powers of lengths (the step's
/// estimate) and inverse sixth ones must be floats. Looks at `grains`.
void refuse_sizes_beyond_floats(const MeshedPacking& packing, std::span<const std::int32_t> grains,
                                const std::string& name);

/// Two grains that lie in the same place, as copies do, have no gap that contact could measure. Collective.
void refuse_shared_places(const Model& model, const std::string& name, const Communicator& ranks);

} // namespace mpfem
