#pragma once
// What all ranks do together succeeds on all of them, or fails on all of them with the same error.

#include <functional>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Collective. Calls `work`, which may communicate only where it cannot have failed before on any rank. Where it throws
/// on some ranks, all throw the error of the one whose `place` is lowest (of equal ones that of the lowest rank): the
/// place is asked for after the failure, and stands for the order in which one rank would have come upon it.
void agree(
    const Communicator& ranks, const std::function<void()>& work,
    const std::function<double()>& place = [] { return 0.0; });

} // namespace mpfem
