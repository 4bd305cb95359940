#pragma once
// Which checkpoints a run writes after a step, and why.

#include "solver/run/run_records.hpp"

namespace mpfem {

/// Why a rolling checkpoint is due although no stage or density requires one. Larger ones count first.
enum class CheckpointReason : int { none, interval, out_of_time, interrupted };

/// Writes the checkpoints of a run. All arguments must outlive it.
class CheckpointWriter {
public:
  /// The time limit and the first interval count from now on.
  CheckpointWriter(Simulation& simulation, RunRecords& records, const RunOptions& options);

  /// Collective. After an advance(): writes the checkpoints of densities that were passed and of a stage that is
  /// complete, and the rolling one with them or for the reason that is returned, the same on all ranks. Throws
  /// StorageError.
  CheckpointReason write_due();

private:
  CheckpointReason reason() const;
  void save_stage_checkpoint() const;

  Simulation& simulation_;
  RunRecords& records_;
  const RunOptions& options_;
  Profile::Clock::time_point start_, last_;
};

} // namespace mpfem
