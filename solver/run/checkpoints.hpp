#pragma once
// The checkpoints of a run: their names, in which order they are written, and from which one a run continues.
//
// A rolling checkpoint is written under another name, read back, and only then replaces the one before, which stays as
// RUN.checkpoint.previous.h5. Checkpoints of stages and densities are written before the rolling one that counts them
// as done: whenever a run is killed, its rolling checkpoint promises nothing that is not on disk.

#include <functional>
#include <string>
#include <vector>

#include "solver/output/checkpoint.hpp"
#include "solver/parallel/communicator.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Path of the checkpoint at a relative density: RUN.D0.850.checkpoint.h5.
std::string density_checkpoint_path(const std::string& run_file, double relative_density);
/// Paths of all checkpoints that stay when the run is complete.
std::vector<std::string> kept_checkpoints(const Scenario& scenario, const std::string& run_file);
/// The same with the rolling one and that before it.
std::vector<std::string> all_checkpoints(const Scenario& scenario, const std::string& run_file);
/// Bytes of the files that the run has written so far.
double size_on_disk(const Scenario& scenario, const std::string& run_file);

/// Folder of a run's snapshots while it is unfinished.
std::string parts_folder(const std::string& run_file);
/// Name of a snapshot's file in that folder: snapshot-0007.h5.
std::string snapshot_name(std::size_t number);
/// Its path.
std::string snapshot_path(const std::string& run_file, const std::string& name);

/// What identifies the checkpoints that belong to a run.
struct RunIdentity {
  std::string run_file;
  std::string scenario_text;
  std::string packing_hash;
  std::string from; ///< checksum of the checkpoint at which the run begins, "packing", or empty: any
};

/// Whether the path holds a checkpoint that this run wrote. Reads a few values of it, not its arrays.
bool is_checkpoint_of(const std::string& path, const RunIdentity& run);

/// Collective. Replaces the rolling checkpoint: `write` writes the new one to the path that it is given, on all ranks
/// together. Throws StorageError if what was written cannot be read back; then the previous checkpoint stays.
void replace_rolling_checkpoint(const Communicator& ranks, const std::string& run_file,
                                const std::function<void(const std::string&)>& write);

/// Checkpoints of stages and densities that a run must have written when it is in this stage. `densities_passed`:
/// number of output.checkpoint_relative_densities passed; `start_density`: relative density at which it began.
std::vector<std::string> promised_checkpoints(const Scenario& scenario, const std::string& run_file, std::int64_t stage,
                                              bool stage_complete, std::int64_t densities_passed, double start_density);
/// The same of a run that is complete; `largest_density`: the largest relative density of its steps.
std::vector<std::string> promised_checkpoints(const Scenario& scenario, const std::string& run_file,
                                              double start_density, double largest_density);

/// The paths that hold no checkpoint of this run.
std::vector<std::string> missing_checkpoints(const std::vector<std::string>& promised, const RunIdentity& run);

/// Checkpoints from which the run can go on, best first: the rolling one, the one before, and those of stages and
/// densities, latest first. All exist; only the rolling one may belong to another run.
std::vector<std::string> resumable_checkpoints(const Scenario& scenario, const RunIdentity& run);

/// Names of the files that interrupted writes of this run may have left.
std::vector<std::string> partial_files(const Scenario& scenario, const std::string& run_file);

/// Removes partial files that interrupted writes of this run have left.
void remove_partial_files(const Scenario& scenario, const std::string& run_file);

/// Removes rolling checkpoints and snapshots of the run, in an order that leaves nothing misleading when it is cut
/// short.
void remove_unfinished(const std::string& run_file);

} // namespace mpfem
