#pragma once
// A run of a scenario, from the checks of its output to its end.

#include "solver/parallel/communicator.hpp"
#include "solver/run/run_options.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Collective. Runs a scenario to its end and writes the run file. All ranks have the same scenario and options. Throws
/// SimulationError (a readable run file with the last state was written), Interrupted (checkpoint and run file
/// written), StorageError, InputError, on all ranks alike.
void run_scenario(const Scenario& scenario, const RunOptions& options, const Communicator& ranks = Communicator());

} // namespace mpfem
