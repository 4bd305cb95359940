#pragma once
// What a run would do and need, reported before it starts.

#include <optional>
#include <string>

#include "solver/parallel/communicator.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

struct CheckOptions {
  std::optional<std::string> from; ///< checkpoint in which a branch begins
  int threads = 1;
  bool quiet = false; ///< print warnings only
};

/// Collective. Prints what a run would do: grains, tets, memory, stages, steps, estimated time from steps measured
/// here. Throws InputError if the run would be refused.
void check_scenario(const Scenario& scenario, const CheckOptions& options, const Communicator& ranks = Communicator());

} // namespace mpfem
