#pragma once
// How a run goes on from a checkpoint, its own or that of another run. All of it is collective.

#include <string>

#include "solver/output/checkpoint.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Writes a checkpoint of the current state, after an advance(). Throws StorageError as write_checkpoint.
void save_checkpoint(const std::string& path, const Simulation& simulation, const RunRecord& record,
                     const Communicator& ranks = Communicator());

/// Goes on with the same scenario. Throws InputError if the checkpoint is damaged, belongs to another packing or
/// scenario, or was written by a build that would not continue it bitwise.
void resume(const std::string& path, Simulation& simulation, RunRecord& record,
            const Communicator& ranks = Communicator());

/// Begins the scenario's first stage in the state of another run. Bonds keep the law by which they formed; future bonds
/// get the scenario's. Throws InputError as resume(), and if the scenario changes what a branch must keep.
void begin_branch(const std::string& path, Simulation& simulation, const Communicator& ranks = Communicator());

} // namespace mpfem
