#pragma once
// A hash that shows whether two programs number nodes and tets alike.

#include <cstdint>

#include "solver/model/model.hpp"

namespace mpfem {

/// Collective. Hash of the order of nodes and tets in the arrays of a checkpoint; the same on all ranks.
std::uint64_t numbering_hash(const Communicator& ranks, const Model& model);

} // namespace mpfem
