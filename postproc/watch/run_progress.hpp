#pragma once
// Progress of a run, from the files that it writes while it works.
//
// mpfem writes a rolling checkpoint, RUN.checkpoint.h5, every output.checkpoint_interval seconds and at the end of each
// stage; it holds the history up to then. The previous one stays as RUN.checkpoint.previous.h5. At the end RUN.h5
// replaces both (docs/reliability.md). Files are opened read-only, and no lock of a run is taken.

#include <optional>
#include <string>
#include <vector>

namespace mpfem {

/// Values of a row of the history.
struct ProgressRow {
  double stage = 0; ///< number, from 0
  double step = 0;
  double time = 0;                                                     ///< s
  double relative_density = 0, mean_stress = 0, deviatoric_stress = 0; ///< 1, MPa, MPa
  double time_step = 0;                                                ///< s
  double kinetic = 0;                                                  ///< mJ
  double stored = 0, dissipated = 0;                                   ///< mJ, as in common/stage_energy.hpp
  double external_work = 0, residual = 0;                              ///< mJ
  double penetration = 0;                                              ///< over the element size
};

/// A stage as in the scenario.
struct PlannedStage {
  std::string name, type;
};

/// The run's plan from its scenario; empty where that cannot be read.
struct RunPlan {
  std::vector<PlannedStage> stages;
  int history_rows = 200; ///< rows in the expected time of a stage
};

/// Whether an mpfem process is writing the run's files, according to RUN.lock.
enum class AtWork {
  no,     ///< there is no RUN.lock
  yes,    ///< a process on this machine holds it
  unknown ///< no visible process holds it: mpfem runs on another machine, or was killed
};

/// The newest state of a run.
struct RunProgress {
  std::string file;   ///< the file that was read
  double written = 0; ///< s, when it was written (system clock)
  std::string status; ///< of a run file: "complete", "interrupted", "failed: REASON"; empty for a checkpoint
  AtWork at_work = AtWork::no;
  RunPlan plan;
  std::vector<ProgressRow> rows;
  double step = 0;                     ///< of the state, up to one row after the last row
  std::vector<std::string> stage_ends; ///< [completed stages], what ended each
  /// Wall-clock time (s) per unit of stage_share(), between the last two checkpoints; empty where it is not known.
  std::optional<double> seconds_per_stage;

  bool ended() const { return !status.empty(); }
};

/// The newest state in the files of a run. `rows` is empty if a run has started over an older run file (RUN.lock is
/// newer than it) and has no checkpoint yet. Throws InputError where there is no file of the run at all, or none that
/// can be read; retries for a file that is being renamed.
RunProgress read_progress(const std::string& run_file);

/// Rows of the current stage, over the number of rows in its expected time: approximately the elapsed share of that
/// time. Steps since the last row count as part of the next row. A stage may end earlier or later.
double stage_share(const RunProgress& progress);

} // namespace mpfem
