#pragma once
// What a meshed packing must satisfy so that a model can be built from it. All of these functions throw InputError;
// `name` stands for the file.

#include <string>

#include "solver/model/model.hpp"

namespace mpfem {

/// Checks array sizes and node numbers; refuses tetrahedra that are inverted or degenerate and coordinates not finite.
void check_packing(const MeshedPacking& packing, const std::string& name);

/// If tets are in single precision, they must be 1e-4 … 1e4 mm large (the longest edge at their first corner): eighth
/// powers of lengths (the step estimate) and inverse sixth powers must fit into floats. They must also be at least a
/// thousandth of their grain, since floats are measured from its middle. Checks `grains`.
void refuse_sizes_beyond_floats(const MeshedPacking& packing, std::span<const std::int32_t> grains,
                                const std::string& name);

/// Two grains that lie in the same place, as copies do, have no gap that contact could measure. Collective.
void refuse_shared_places(const Model& model, const std::string& name, const Communicator& ranks);

} // namespace mpfem
