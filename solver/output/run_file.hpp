#pragma once
// Snapshots, and the run file that gathers them with history and provenance.
//
// While a run goes on, each snapshot is a complete file of its own beside the run file (written as .partial and renamed),
// so that a kill at any moment leaves no broken file. They are merged into the run file at the end.

#include <string>
#include <vector>

#include "solver/output/history.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Writes a snapshot of the present time level to its own file.
void write_snapshot_file(const std::string& path, Simulation& simulation);

struct Provenance {
  std::string scenario_text;
  std::string status; ///< complete, failed: REASON, interrupted
  int threads = 1;
  double wall_time = 0; ///< s
  std::vector<std::string> profile_name;
  std::vector<double> profile_seconds;
  std::vector<StageResult> stages; ///< those that are complete
  std::string from;                ///< where the run began: checksum of a checkpoint, "packing", or empty: not known
};

/// Writes RUN.h5 from history, snapshot files and provenance. Throws StorageError.
void write_run_file(const std::string& path, const Model& model, const std::vector<HistoryRow>& history,
                    const std::vector<std::string>& snapshot_files, const Provenance& provenance);

} // namespace mpfem
