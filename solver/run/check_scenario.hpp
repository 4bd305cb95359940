#pragma once
// What a run would do and need, reported before it starts.

#include <optional>
#include <string>

#include "solver/parallel/communicator.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Collective. Prints what a run would do: grains, tets, memory, stages, steps, estimated time from steps measured
/// here; if `from` names a checkpoint, for a branch that begins there. Throws InputError if the run would be refused.
void check_scenario(const Scenario& scenario, int threads, const std::optional<std::string>& from,
                    const Communicator& ranks = Communicator());

} // namespace mpfem
