#pragma once
// Snapshots, and the run file that gathers them with history and provenance.
//
// While a run goes on, each snapshot is a separate, complete file beside the run file (written as .partial and
// renamed), so that a kill at any moment leaves no broken file. They are merged into the run file at the end.

#include <string>
#include <vector>

#include "solver/boundary/box.hpp"
#include "solver/boundary/tools.hpp"
#include "solver/boundary/wall_friction.hpp"
#include "solver/kernels/contact_forces.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/output/history.hpp"
#include "solver/output/stage_result.hpp"
#include "solver/output/tool_history.hpp"

namespace mpfem {

/// The content of a snapshot, between evaluate_forces() and advance().
struct SnapshotState {
  const Model& model;
  const Contact& contact;
  const Box& box;
  const WallFriction& wall_friction;
  const Tools& tools;
  double time = 0; ///< s
  std::int64_t step = 0;
  double relative_density = 0;
};

/// Collective. Writes a snapshot to its own file, which does not depend on the number of ranks. Throws StorageError on
/// all ranks if the first cannot write (gathered_file.hpp).
void write_snapshot_file(const std::string& path, const SnapshotState& state,
                         const Communicator& ranks = Communicator());

/// How a run was made and how it ended.
struct Provenance {
  std::string scenario_text;
  std::string status; ///< complete, failed: REASON, interrupted
  int threads = 1;    ///< of each rank
  int ranks = 1;
  double wall_time = 0; ///< s
  std::vector<std::string> profile_name;
  std::vector<double> profile_seconds;
  std::vector<StageResult> stages; ///< those that are complete
  OptionalColumns columns;
  std::string from; ///< where the run began: checksum of a checkpoint, "packing", or empty: not known
};

/// What a run recorded row by row.
struct RunHistory {
  const std::vector<HistoryRow>& rows;
  const Tools& tools;
  const std::vector<ToolRow>& tool_rows; ///< of all tools for each row
};

/// Collective. Writes RUN.h5 from history, snapshot files and provenance of the first rank. Throws StorageError as
/// write_snapshot_file, and InputError if a snapshot file cannot be read.
void write_run_file(const std::string& path, const Model& model, const RunHistory& history,
                    const std::vector<std::string>& snapshot_files, const Provenance& provenance,
                    const Communicator& ranks = Communicator());

/// What a run file says of its run.
struct RunSummary {
  std::string status, scenario_text, packing_hash;
  std::string from;           ///< empty: not known
  double first_density = 0;   ///< relative density of the first row
  double largest_density = 0; ///< of all rows
};
/// Throws InputError if the file is not a run file.
RunSummary read_run_summary(const std::string& path);

} // namespace mpfem
