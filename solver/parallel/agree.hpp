#pragma once
// What all ranks do together succeeds on all of them, or fails on all of them with the same error.

#include <functional>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Collective. Calls `work`, which may communicate only as long as it cannot have failed on any rank. If it throws on
/// some ranks, all throw the error whose `place` is lowest (at equal places, that of the lowest rank). `place` is
/// called after the failure. It gives the order in which a single rank would have met the errors.
void agree(
    const Communicator& ranks, const std::function<void()>& work,
    const std::function<double()>& place = [] { return 0.0; });

} // namespace mpfem
