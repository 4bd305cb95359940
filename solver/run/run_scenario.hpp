#pragma once
// The time loop: stages, rows, snapshots, checkpoints, progress, and the end of a run, good or bad.

#include <optional>
#include <string>

#include "solver/parallel/communicator.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Options of `mpfem run`.
struct RunOptions {
  std::string output;              ///< RUN.h5
  std::string scenario_file;       ///< never to be overwritten
  bool resume = false;             ///< go on from the rolling checkpoint if there is one
  std::optional<std::string> from; ///< begin the first stage from this checkpoint's state
  int threads = 1;
  bool quiet = false;
  double time_limit = 0; ///< s of wall-clock time, 0 none
};

/// Collective. Runs a scenario to its end and writes the run file. All ranks have the same scenario and options. Throws
/// SimulationError (a readable run file with the last state was written), Interrupted (checkpoint and run file
/// written), StorageError, InputError, on all ranks alike.
void run_scenario(const Scenario& scenario, const RunOptions& options, const Communicator& ranks = Communicator());

} // namespace mpfem
