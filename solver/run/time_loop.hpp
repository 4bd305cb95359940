#pragma once
// The time loop of a run: steps, and between them rows, snapshots, checkpoints and stages, to the run's end, good or
// bad.

#include "common/errors.hpp"
#include "solver/run/checkpoint_writer.hpp"
#include "solver/run/continuation.hpp"
#include "solver/run/energy_check.hpp"
#include "solver/run/redistribution.hpp"
#include "solver/run/run_options.hpp"
#include "solver/run/run_pace.hpp"
#include "solver/run/run_records.hpp"
#include "solver/run/run_report.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Runs a prepared simulation. All arguments must outlive it.
class TimeLoop {
public:
  /// `preparation`: s of wall-clock time that reading and preparing took. Times count from now on, those of progress
  /// from `origin`.
  TimeLoop(Simulation& simulation, RunRecords& records, const Continuation& continuation, RunReport& report,
           const RunOptions& options, double preparation, std::optional<PaceOrigin>& origin);

  /// Collective, to be called once. Runs to the end of the last stage and writes the run file: none is returned. Or to
  /// a checkpoint from which the run is to go on with the owners of grains that are returned. Throws as run_scenario().
  Owners run();

private:
  bool loop();
  bool in_last_stage() const;
  void begin_next_stage();
  void record();
  void record_row();
  void save_checkpoints();
  void report_progress();
  RunPosition position() const;
  [[noreturn]] void save_failed_state(const SimulationError& error);
  std::string text_of_checkpoints() const;
  void complete();

  const RunOptions& options_;
  const Communicator& ranks_;
  Simulation& simulation_;
  RunRecords& records_;
  const Continuation& continuation_;
  RunReport& report_;
  EnergyCheck energy_check_;
  CheckpointWriter checkpoints_;
  RunPace pace_;
  Redistribution redistribution_;
  Owners new_owners_;
  std::int64_t last_sound_step_ = -1; ///< whose forces and history row raised no error
};

} // namespace mpfem
