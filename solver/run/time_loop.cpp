#include "solver/run/time_loop.hpp"

#include <optional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/parallel/root.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/untouched_tools.hpp"

namespace mpfem {

namespace {

/// The step of a checkpoint; none if it cannot be read.
std::optional<std::int64_t> step_of(const std::string& checkpoint) {
  try {
    return CheckpointReader(checkpoint).step();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

} // namespace

TimeLoop::TimeLoop(Simulation& simulation, RunRecords& records, const Continuation& continuation, RunReport& report,
                   const RunOptions& options, double preparation, std::optional<PaceOrigin>& origin)
    : options_(options), ranks_(simulation.ranks()), simulation_(simulation), records_(records),
      continuation_(continuation), report_(report), energy_check_(simulation.model(), records.history()),
      checkpoints_(simulation, records, options), pace_(simulation, origin),
      redistribution_(simulation, report, options.redistribute, preparation) {}

Owners TimeLoop::run() {
  try {
    if (!loop()) return new_owners_;
  } catch (const SimulationError& error) {
    save_failed_state(error);
  }
  complete();
  return std::nullopt;
}

/// Runs to the end of the last stage (true), or to a checkpoint after which the grains have new owners (false).
bool TimeLoop::loop() {
  for (;;) {
    simulation_.evaluate_forces();
    record();
    last_sound_step_ = simulation_.state().step;
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

bool TimeLoop::in_last_stage() const {
  return simulation_.state().stage + 1 == static_cast<std::int64_t>(simulation_.scenario().stages.size());
}

/// The stage before may have destroyed what this stage needs. That is a failure of the run, whose state is saved.
void TimeLoop::begin_next_stage() {
  try {
    simulation_.begin_next_stage();
    for (const std::string& text : simulation_.tools().moved_back()) report_.note(text);
    records_.begin_stage();
  } catch (const InputError& error) {
    throw SimulationError(error.what());
  }
}

/// Row and snapshot of the current time level, if they are due.
void TimeLoop::record() {
  const bool stage_end = simulation_.stage_complete();
  const std::int64_t rows = records_.rows_in_stage();
  if (simulation_.stage_run().loading_rate().at_slowest)
    report_.slowest_speed(simulation_.stage().name, simulation_.relative_density());
  if (stage_end || records_.row_is_due()) record_row();
  records_.take_snapshots(stage_end, rows);
}

void TimeLoop::record_row() {
  const HistoryRow& row = records_.add_row();
  report_.row(records_.history(), {.rows_in_stage = records_.rows_in_stage(),
                                   .rows_expected = simulation_.scenario().output.history_rows,
                                   .ends_stage = simulation_.stage_complete(),
                                   .controlled_by_contact = simulation_.step_estimate().state().controlled_by_contact,
                                   .nanoseconds = pace_.nanoseconds_per_tet_step()});
  report_.energy_error(energy_check_.require(row), row.step);
}

/// Saves the state where that is due. Throws Interrupted if the run was told to stop.
void TimeLoop::save_checkpoints() {
  const CheckpointReason reason = checkpoints_.write_due();
  if (reason == CheckpointReason::interval) new_owners_ = redistribution_.new_owners(pace_.remaining());
  if (reason == CheckpointReason::none || reason == CheckpointReason::interval) return;
  records_.write_result("interrupted");
  throw Interrupted(fmt::format("{} at step {}, relative density {:.4f}; continue with --resume",
                                reason == CheckpointReason::interrupted ? "interrupted" : "stopped by --time-limit",
                                simulation_.state().step, simulation_.relative_density()));
}

void TimeLoop::report_progress() {
  constexpr std::int64_t steps_between = 16;
  if (simulation_.state().step % steps_between != 0) return;
  report_.stable_step(simulation_.step_estimate().stable_step());
  report_.progress(pace_.fraction_done(), position());
}

RunPosition TimeLoop::position() const {
  return {simulation_.state().step, simulation_.relative_density(), simulation_.box().mean_stress()};
}

/// The failed state is worth a look: saves a snapshot of it, and everything recorded so far.
void TimeLoop::save_failed_state(const SimulationError& error) {
  const auto checkpoints = root_lists(ranks_, [this] { return std::vector{text_of_checkpoints()}; });
  try {
    records_.save_snapshot();
    records_.write_result(fmt::format("failed: {}", error.what()));
  } catch (const StorageError& storage) {
    throw SimulationError(fmt::format("{}; its state could not be saved: {}", error.what(), storage.what()));
  }
  throw SimulationError(
      fmt::format("{}; history and last state are in {}; {}", error.what(), options_.output, checkpoints.front()));
}

/// Which checkpoint is the last before a failure. A checkpoint is written before the forces of its step are evaluated,
/// so it may be of the failed step.
std::string TimeLoop::text_of_checkpoints() const {
  std::string failed;
  for (const std::string& path : continuation_.resumable()) {
    const std::optional<std::int64_t> step = step_of(path);
    if (step && *step <= last_sound_step_)
      return fmt::format("the last checkpoint before the failure is {}{}", path, failed);
    if (step && failed.empty()) failed = fmt::format(" ({} is of the failed step)", path);
  }
  return "there is no earlier checkpoint" + failed;
}

void TimeLoop::complete() {
  root_does(ranks_, [this] { continuation_.check_written_checkpoints(); });
  records_.write_result("complete");
  root_does(ranks_, [this] { remove_unfinished(options_.output); });
  report_.finish(position(), options_.output);
  const RunRecord record = records_.with_times();
  // A branch counts its own steps; a run that was resumed, those of all its parts.
  const double steps = record.history.back().step - record.history.front().step;
  report_.profile(part_times(record.profile_seconds, record.wall_time), record.wall_time,
                  steps * static_cast<double>(simulation_.model().tets()));
  report_.quality(record.history);
  for (const std::string& text : untouched_tools(simulation_.scenario(), record.tool_history)) report_.warning(text);
}

} // namespace mpfem
