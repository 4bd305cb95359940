#pragma once
// The complete state of a run on disk. A resumed run goes on bitwise as if nothing had happened.

#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace mpfem {

/// What a run carries besides the simulation.
struct RunRecord {
  std::vector<HistoryRow> history;
  std::vector<std::string> snapshot_files;
  std::vector<StageResult> stages; ///< those that are complete
  std::string from;                ///< where the run began: checksum of a checkpoint, "packing", or empty: not known
  double wall_time = 0;            ///< s, of all parts of the run so far
  std::array<double, profile_parts> profile_seconds{};
};

/// Writes the state after an advance() (before the next evaluate_forces()). Written beside and renamed.
void write_checkpoint(const std::string& path, const Simulation& simulation, const RunRecord& record,
                      const std::string& scenario_text);

/// Replaces the simulation's state. Throws InputError where the file is damaged (checksum), belongs to another mesh, to
/// another scenario text (unless `any_scenario`), or was written by a build with another block width.
void read_checkpoint(const std::string& path, Simulation& simulation, RunRecord& record,
                     const std::string& scenario_text, bool any_scenario);

/// Begins the scenario's first stage at the state of an earlier run. Bonds keep the law by which they formed, the scenario's is
/// that of bonds to come. Throws InputError as read_checkpoint, and where the scenario is one of other matter.
void begin_branch(const std::string& path, Simulation& simulation, const std::string& scenario_text);

/// Reads all arrays of a checkpoint. Throws InputError where they do not match its checksum or cannot be read.
void verify_checkpoint(const std::string& path);

/// What tells a checkpoint's state from others. Throws InputError where the file is no checkpoint.
std::string checkpoint_checksum(const std::string& path);

} // namespace mpfem
