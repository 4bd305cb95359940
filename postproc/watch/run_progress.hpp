#pragma once
// How far a run has come, from the files that it leaves while it works.
//
// mpfem writes a rolling checkpoint, RUN.checkpoint.h5, every output.checkpoint_interval seconds and at each stage's
// end; it holds the history so far. The one before stays as RUN.checkpoint.previous.h5. At the end both give way to
// RUN.h5 (docs/reliability.md). Files are opened to be read only, and no lock of a run is taken.

#include <optional>
#include <string>
#include <vector>

namespace mpfem {

/// Of a row of the history.
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

struct PlannedStage {
  std::string name, type;
};

/// What the scenario says of the run's course; empty where it cannot be read.
struct RunPlan {
  std::vector<PlannedStage> stages;
  int history_rows = 200; ///< in the time that a stage is expected to take
};

/// Whether an mpfem writes the run's files, by RUN.lock.
enum class AtWork {
  no,     ///< there is no such file
  yes,    ///< a process of this machine holds it
  unknown ///< it is there, and held by none that is seen: mpfem works on another machine, or was killed
};

struct RunProgress {
  std::string file;   ///< from which all of it was read
  double written = 0; ///< s, when it was (of the system's clock)
  std::string status; ///< of a run file: complete, interrupted, failed: REASON; empty for a checkpoint
  AtWork at_work = AtWork::no;
  RunPlan plan;
  std::vector<ProgressRow> rows;
  double step = 0;                     ///< that of the state, up to a row later than the last row
  std::vector<std::string> stage_ends; ///< of the stages that are complete, what ended each
  /// s per unit of stage_share(), of wall-clock time between the last two checkpoints; none where it is not known.
  std::optional<double> seconds_per_stage;

  bool ended() const { return !status.empty(); }
};

/// The newest state that the files of a run hold. Where a run has begun over an older run file, RUN.lock is the newer
/// one, and there is nothing to see before its first checkpoint: then `rows` is empty. Throws InputError where there is
/// no file of the run at all, or none that can be read; a file that is renamed meanwhile is looked for again.
RunProgress read_progress(const std::string& run_file);

/// Rows of the present stage over those that it writes in the time that it was expected to take: about the share of
/// that time that has passed. Steps since the last row count as part of the next. A stage may end before or after it.
double stage_share(const RunProgress& progress);

} // namespace mpfem
