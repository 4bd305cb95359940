#include "solver/run/run_scenario.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "common/available_memory.hpp"
#include "common/errors.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/run_lock.hpp"
#include "solver/parallel/leader.hpp"
#include "solver/run/check_output.hpp"
#include "solver/run/checkpoint_writer.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/continuation.hpp"
#include "solver/run/energy_check.hpp"
#include "solver/run/interrupt.hpp"
#include "solver/run/needs.hpp"
#include "solver/run/plan_text.hpp"
#include "solver/run/programme.hpp"
#include "solver/run/redistribution.hpp"
#include "solver/run/run_pace.hpp"
#include "solver/run/run_records.hpp"
#include "solver/run/run_report.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

namespace {

enum class RunEnd {
  complete,
  must_start_again, ///< nothing that could be resumed is usable: without --resume
  redistributed     ///< the checkpoint just written goes on with other owners of grains
};

/// The time loop of a prepared simulation.
class Runner {
public:
  /// `preparation`: s of wall-clock time that reading and preparing took.
  Runner(Simulation& simulation, RunRecords& records, const Continuation& continuation, RunReport& report,
         const RunOptions& options, double preparation)
      : options_(options), ranks_(simulation.ranks()), simulation_(simulation), records_(records),
        continuation_(continuation), report_(report), energy_check_(simulation.model(), records.history()),
        checkpoints_(simulation, records, options), pace_(simulation),
        redistribution_(simulation, report, preparation) {}

  /// Collective. Throws as run_scenario().
  RunEnd run() {
    try {
      if (!loop()) return RunEnd::redistributed;
    } catch (const SimulationError& error) {
      save_failed_state(error);
    }
    complete();
    return RunEnd::complete;
  }

  /// After redistributed.
  const Owners& new_owners() const { return new_owners_; }

private:
  /// Runs to the end of the last stage (true), or to a checkpoint after which the grains have new owners (false).
  bool loop() {
    for (;;) {
      simulation_.evaluate_forces();
      record();
      if (simulation_.stage_complete()) {
        report_.stage_end(records_.end_stage(), records_.history(), simulation_.stage().damping.rate != 0);
        if (in_last_stage()) return true;
        begin_next_stage();
      }
      simulation_.advance();
      save_checkpoints();
      if (new_owners_) return false;
      report_progress();
    }
  }

  bool in_last_stage() const {
    return simulation_.state().stage + 1 == static_cast<std::int64_t>(simulation_.scenario().stages.size());
  }

  /// The stage before may have destroyed what this stage needs. That is a failure of the run, whose state is saved.
  void begin_next_stage() {
    try {
      simulation_.begin_next_stage();
      records_.begin_stage();
    } catch (const InputError& error) {
      throw SimulationError(error.what());
    }
  }

  /// Row and snapshot of the present time level, if they are due.
  void record() {
    const bool stage_end = simulation_.stage_complete();
    const std::int64_t rows = records_.rows_in_stage();
    if (simulation_.stage_run().loading_rate().at_slowest)
      report_.slowest_speed(simulation_.stage().name, simulation_.relative_density());
    if (stage_end || records_.row_is_due()) record_row();
    records_.take_snapshots(stage_end, rows);
  }

  void record_row() {
    const HistoryRow& row = records_.add_row();
    report_.row(records_.history(), {.rows_in_stage = records_.rows_in_stage(),
                                     .rows_expected = simulation_.scenario().output.history_rows,
                                     .ends_stage = simulation_.stage_complete(),
                                     .controlled_by_contact = simulation_.step_estimate().state().controlled_by_contact,
                                     .nanoseconds = pace_.nanoseconds_per_tet_step()});
    report_.energy_error(energy_check_.require(row), row.step);
  }

  /// Saves the state where that is due. Throws Interrupted where the run is to stop for now.
  void save_checkpoints() {
    const CheckpointReason reason = checkpoints_.write_due();
    if (reason == CheckpointReason::interval) new_owners_ = redistribution_.new_owners(pace_.remaining());
    if (reason == CheckpointReason::none || reason == CheckpointReason::interval) return;
    records_.write_result("interrupted");
    throw Interrupted(fmt::format("{} at step {}, relative density {:.4f}; continue with --resume",
                                  reason == CheckpointReason::interrupted ? "interrupted" : "stopped by --time-limit",
                                  simulation_.state().step, simulation_.relative_density()));
  }

  void report_progress() {
    constexpr std::int64_t steps_between = 16;
    if (simulation_.state().step % steps_between != 0) return;
    report_.stable_step(simulation_.step_estimate().stable_step());
    report_.progress(pace_.fraction_done(), position());
  }

  RunPosition position() const {
    return {simulation_.state().step, simulation_.relative_density(), simulation_.box().mean_stress()};
  }

  /// The failed state is worth a look: saves a snapshot of it, and everything recorded so far.
  [[noreturn]] void save_failed_state(const SimulationError& error) {
    const auto checkpoints = leader_lists(ranks_, [this] { return continuation_.resumable(); });
    try {
      records_.save_snapshot();
      records_.write_result(fmt::format("failed: {}", error.what()));
    } catch (const StorageError& storage) {
      throw SimulationError(fmt::format("{}; its state could not be saved: {}", error.what(), storage.what()));
    }
    throw SimulationError(fmt::format("{}; history and last state are in {}; {}", error.what(), options_.output,
                                      checkpoints.empty()
                                          ? "there is no earlier checkpoint"
                                          : "the last checkpoint before the failure is " + checkpoints.front()));
  }

  void complete() {
    leader_does(ranks_, [this] { continuation_.check_written_checkpoints(); });
    records_.write_result("complete");
    leader_does(ranks_, [this] { remove_unfinished(options_.output); });
    report_.finish(position(), options_.output);
    const RunRecord record = records_.with_times();
    // A branch counts its own steps; a run that was resumed, those of all its parts.
    const double steps = record.history.back().step - record.history.front().step;
    report_.profile(part_times(record.profile_seconds, record.wall_time), record.wall_time,
                    steps * static_cast<double>(simulation_.model().tets()));
    report_.quality(record.history);
  }

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
};

/// Reads the packing and makes the model. Both may take a while, so a request to stop is checked in between.
Model load_model(const Scenario& scenario, const RunOptions& options, const Communicator& ranks, const Owners& owners) {
  const std::string checkpoint = checkpoint_path(options.output);
  stop_before_first_step(ranks, checkpoint);
  auto packing = read_packing(scenario.packing_file, ranks, owners);
  stop_before_first_step(ranks, checkpoint);
  Model model = build_model(std::move(packing), scenario, scenario.packing_file, ranks);
  stop_before_first_step(ranks, checkpoint);
  return model;
}

/// How a part of a run ended, and which rank then owns each grain, if that changes.
struct PartEnd {
  RunEnd end = RunEnd::complete;
  Owners new_owners{};
};

/// What a reader of the results should know beforehand.
void report_beginning(const RunReport& report, const std::vector<std::string>& warnings, const Simulation& simulation) {
  for (const std::string& warning : warnings) report.warning(warning);
  for (const std::string& text :
       {mass_scaling_text(simulation.scenario(), simulation.model()), earlier_bonds_text(simulation.contact())})
    if (!text.empty()) report.note(text);
}

/// Prepares a simulation where the run begins, and runs it.
PartEnd run_part(const Scenario& scenario, const RunOptions& options, const Communicator& ranks, const Owners& owners) {
  const auto begun = Profile::Clock::now();
  ThreadTeam team(options.threads);
  Simulation simulation(load_model(scenario, options, ranks, owners), scenario, team, options.from.has_value(), ranks);
  RunReport report(ranks.leads(), options.quiet);
  RunRecord record;
  Continuation continuation(simulation, record, options, report);
  const auto warnings = check_bonds(simulation.model(), scenario, ranks);
  const Beginning beginning = continuation.begin();
  if (beginning == Beginning::must_start_again) return {RunEnd::must_start_again};
  stop_before_first_step(ranks, checkpoint_path(options.output));
  if (beginning != Beginning::complete) report_beginning(report, warnings, simulation);
  check_programme(scenario, simulation.state().stage, simulation.stage_run().state().start, simulation.model(),
                  simulation.step_estimate().stable_step());
  if (beginning == Beginning::complete) return {RunEnd::complete};
  if (beginning == Beginning::fresh) leader_does(ranks, [&] { continuation.discard_unfinished_run(); });
  RunRecords records(simulation, record, options);
  if (beginning == Beginning::fresh) records.pass_checkpoint_densities(); // those that the packing has from the start
  Runner runner(simulation, records, continuation, report, options, Profile::since(begun));
  const RunEnd end = runner.run();
  return {end, runner.new_owners()};
}

} // namespace

void run_scenario(const Scenario& scenario, const RunOptions& given, const Communicator& ranks) {
  RunOptions options = given;
  if (!ranks.leads()) options.quiet = true;
  std::optional<RunLock> lock;
  leader_does(ranks, [&] {
    check_output(scenario, options);
    const std::string scarce =
        check_needs(options.output, needs_of(read_packing_counts(scenario.packing_file), scenario),
                    {.memory = available_memory(), .disk = available_disk_space(options.output)});
    if (!scarce.empty() && !options.quiet) fmt::print(stderr, "mpfem: warning: {}\n", scarce);
    lock.emplace(options.output);
    remove_partial_files(scenario, options.output);
  });
  for (Owners owners;;) {
    const auto begun = Profile::Clock::now();
    const PartEnd part = run_part(scenario, options, ranks, owners);
    if (part.end == RunEnd::complete) return;
    options.resume = part.end == RunEnd::redistributed;
    owners = part.new_owners;
    if (options.time_limit > 0) options.time_limit = std::max(options.time_limit - Profile::since(begun), 1e-9);
  }
}

} // namespace mpfem
