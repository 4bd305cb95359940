#pragma once
// Where a run begins: at the packing, at the checkpoint of --from, at one of its own checkpoints, or not at all if it
// is complete. When it ends, the same rules say which checkpoints must be on disk, and which can be resumed.
//
// A run may be killed, or files removed, at any moment. Its run file and its checkpoints are believed only as far as
// they name the same scenario, packing and beginning, and as what they promise is on disk (checkpoints.hpp).

#include <optional>
#include <string>
#include <vector>

#include "solver/output/checkpoint.hpp"
#include "solver/output/run_file.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/run_options.hpp"
#include "solver/run/run_report.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// How a run begins.
enum class Beginning {
  complete,        ///< not at all: its run file is complete
  resumed,         ///< at one of its own checkpoints
  fresh,           ///< at the packing, or at the checkpoint of --from
  must_start_again ///< no checkpoint can be used, but one has replaced the state: a new simulation must be made
};

/// Finds where a run begins, and restores simulation and record there. All arguments must outlive it.
class Continuation {
public:
  /// `simulation`: before its first step, made with `branch` if options.from is given. `record`: empty.
  Continuation(Simulation& simulation, RunRecord& record, const RunOptions& options, const RunReport& report);

  /// Collective, to be called once, before all others. Throws InputError if the output or a checkpoint belongs to
  /// another run or another beginning, if it counts on a snapshot that is lost, or if none is intact, on all ranks
  /// alike.
  Beginning begin();

  // ---- on the first rank alone, as part of root_does() or root_lists()
  /// Removes the files of an earlier, unfinished run of this name: they would mix with those of a fresh run.
  void discard_unfinished_run() const;
  /// Throws StorageError if a checkpoint that the run has written by now is gone: the run must not be called complete.
  void check_written_checkpoints() const;
  /// Checkpoints from which the run can be resumed, best first.
  std::vector<std::string> resumable() const;

private:
  std::optional<Beginning> resume();
  bool found_complete(std::vector<std::string>& lost) const;
  void refuse_other_run(const RunSummary& run) const;
  bool restore_best(std::vector<std::string>& lost, std::string& damage);
  bool restore(const std::string& path, std::vector<std::string>& lost);
  std::vector<std::string> missing_written_checkpoints() const;
  RunIdentity identity_from(const std::string& from) const;

  const Scenario& scenario_;
  const Communicator& ranks_;
  Simulation& simulation_;
  RunRecord& record_;
  const RunOptions& options_;
  const RunReport& report_;
  RunIdentity identity_;  ///< where it begins if it is fresh
  bool restored_ = false; ///< a checkpoint has replaced the state of the simulation
};

} // namespace mpfem
