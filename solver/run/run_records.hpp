#pragma once
// What a run keeps of its course: rows of the history, snapshots, results of stages and times; and the files that hold
// them. It decides when rows and snapshots are due.

#include <string>
#include <vector>

#include "solver/output/checkpoint.hpp"
#include "solver/run/profile.hpp"
#include "solver/run/run_options.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Adds to a RunRecord while the run goes on. All arguments must outlive it. What takes a row or writes a file is
/// collective.
class RunRecords {
public:
  /// `record`: of the run before this process. The wall-clock time of this process counts from now on.
  RunRecords(Simulation& simulation, RunRecord& record, const RunOptions& options);

  const std::vector<HistoryRow>& history() const { return record_.history; }
  std::int64_t rows_in_stage() const { return record_.rows_in_stage; }

  // ---- between evaluate_forces() and advance()
  /// True if the time for the next row of the stage has come.
  bool row_is_due() const;
  const HistoryRow& add_row();
  /// Takes a snapshot if one is due: at the end of a stage, with a row of the stage, or at a relative density.
  /// `rows_before`: rows_in_stage() before this step.
  void take_snapshots(bool stage_end, std::int64_t rows_before);
  /// Throws StorageError.
  void save_snapshot();
  /// Adds the result of the stage that is complete.
  const StageResult& end_stage();
  void begin_stage() { record_.rows_in_stage = 0; }

  // ---- after an advance()
  /// Densities of output.checkpoint_relative_densities that the packing has now passed for the first time.
  std::vector<double> pass_checkpoint_densities();
  /// Throws StorageError.
  void save_checkpoint(const std::string& path) const;

  // ---- at the end
  /// Writes the run file. `status`: complete, interrupted, or failed: REASON. Throws StorageError.
  void write_result(const std::string& status) const;
  /// The record with the wall-clock times up to now, those of earlier processes included.
  RunRecord with_times() const;

private:
  std::vector<double> pass(const std::vector<double>& densities, std::int64_t& passed) const;

  const Scenario& scenario_;
  Simulation& simulation_;
  RunRecord& record_;
  const RunOptions& options_;
  Profile::Clock::time_point start_;
};

} // namespace mpfem
