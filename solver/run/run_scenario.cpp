#include "solver/run/run_scenario.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "common/available_memory.hpp"
#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/history.hpp"
#include "solver/output/run_file.hpp"
#include "solver/output/run_lock.hpp"
#include "solver/parallel/leader.hpp"
#include "solver/run/balance.hpp"
#include "solver/run/check_output.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/energy_check.hpp"
#include "solver/run/history_schedule.hpp"
#include "solver/run/interrupt.hpp"
#include "solver/run/needs.hpp"
#include "solver/run/observer.hpp"
#include "solver/run/plan_text.hpp"
#include "solver/run/programme.hpp"
#include "solver/run/resume.hpp"
#include "solver/run/run_report.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

namespace {

/// Which rank owns each grain ([grains]); none: by the number of tets.
using Owners = std::optional<std::vector<std::int32_t>>;

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

enum class RunEnd {
  complete,
  must_start_again, ///< nothing that could be resumed is usable: without --resume
  redistributed     ///< the checkpoint just written goes on with other owners of grains
};

/// The time loop and its records.
class Runner {
public:
  Runner(const Scenario& scenario, const RunOptions& options, const Communicator& ranks, const Owners& owners)
      : scenario_(scenario), options_(options), ranks_(ranks), made_(Profile::Clock::now()), team_(options.threads),
        simulation_(load_model(scenario, options, ranks, owners), scenario, team_, options.from.has_value(), ranks),
        report_(ranks.leads(), options.quiet) {
    const auto warnings = check_bonds(simulation_.model(), scenario_, ranks_);
    begin();
    if (must_start_again_) return;
    stop_before_first_step(ranks_, checkpoint_path(options.output));
    if (!already_complete_) {
      for (const std::string& warning : warnings) report_.warning(warning);
      for (const std::string& text :
           {mass_scaling_text(scenario_, simulation_.model()), earlier_bonds_text(simulation_.contact())})
        if (!text.empty()) report_.note(text);
    }
    const RunState& state = simulation_.state();
    const StageRun::State& stage = simulation_.stage_run().state();
    check_programme(scenario_, state.stage, stage.start, simulation_.model(),
                    simulation_.step_estimate().stable_step());
    energy_check_.emplace(simulation_.model(), record_.history);
    expected_ = forecast(scenario_, state.stage, stage.start, simulation_.model());
    first_expected_ = state.stage;
    if (starts_again_) pass_densities();
  }

  RunEnd run() {
    if (must_start_again_) return RunEnd::must_start_again;
    if (already_complete_) return RunEnd::complete;
    if (starts_again_) leader_does(ranks_, [this] { drop_unfinished_run(); });
    start_ = last_checkpoint_ = Profile::Clock::now();
    reload_seconds_ = age();
    done_at_start_ = fraction_done();
    steps_at_start_ = measured_from_step_ = simulation_.state().step;
    try {
      if (!loop()) return RunEnd::redistributed;
    } catch (const SimulationError& error) {
      const std::string good = last_checkpoint_text();
      // The failed state is worth a look: save a snapshot of it, and everything recorded so far.
      try {
        save_snapshot();
        write_result(fmt::format("failed: {}", error.what()));
      } catch (const StorageError& storage) {
        throw SimulationError(fmt::format("{}; its state could not be saved: {}", error.what(), storage.what()));
      }
      throw SimulationError(fmt::format("{}; history and last state are in {}{}", error.what(), options_.output, good));
    }
    leader_does(ranks_, [this] { check_promises(); });
    write_result("complete");
    leader_does(ranks_, [this] { remove_unfinished(options_.output); });
    report_.finish(position(), options_.output);
    report_profile();
    report_.quality(record_.history);
    return RunEnd::complete;
  }

  /// After redistributed.
  const Owners& new_owners() const { return new_owners_; }
  /// s of wall-clock time since this was made.
  double age() const { return Profile::since(made_); }

private:
  /// "; the last checkpoint before the failure is FILE", or that there is none.
  std::string last_checkpoint_text() const {
    const auto checkpoints = leader_lists(ranks_, [this] { return resumable_checkpoints(scenario_, itself()); });
    return checkpoints.empty() ? "; there is no earlier checkpoint"
                               : fmt::format("; the last checkpoint before the failure is {}", checkpoints.front());
  }

  void begin() {
    const std::string from = leader_says(
        ranks_, [this] { return options_.from ? checkpoint_checksum(*options_.from) : std::string("packing"); });
    identity_ = {options_.output, scenario_.text, hash_text(simulation_.model().mesh_hash), from};
    if (options_.resume && resume()) return;
    if (must_start_again_) return;
    if (options_.from) {
      begin_branch(*options_.from, simulation_, ranks_);
      first_step_ = simulation_.state().step;
    }
    record_.from = from;
    starts_again_ = true;
  }

  /// This run, from wherever it began.
  RunIdentity itself() const {
    RunIdentity identity = identity_;
    identity.from = record_.from;
    return identity;
  }

  /// Continues from the best checkpoint, or finds the run complete. False if there is nothing to continue from.
  bool resume() {
    std::vector<std::string> lost; // checkpoints that should be on disk and are not
    already_complete_ = leader_finds(ranks_, [&] { return !rolling_checkpoint_exists() && is_complete(lost); });
    if (already_complete_) {
      leader_does(ranks_, [this] { remove_unfinished(options_.output); }); // of a run killed while it tidied up
      report_.note(options_.output + " is already complete");
      return true;
    }
    lost = leader_lists(ranks_, [&] { return lost; });
    std::string damage;
    for (const std::string& path :
         leader_lists(ranks_, [this] { return resumable_checkpoints(scenario_, identity_); })) {
      try {
        leader_does(ranks_, [&] { verify_checkpoint(path); });
      } catch (const InputError& error) {
        report_.warning_despite_quiet(fmt::format("{}; looking for an earlier checkpoint", error.what()));
        if (damage.empty()) damage = error.what();
        continue;
      }
      if (!restore(path, lost)) continue;
      if (path == previous_checkpoint_path(options_.output)) // whatever is in the rolling one's place is worse
        leader_does(ranks_, [&] { std::filesystem::rename(path, checkpoint_path(options_.output)); });
      if (!lost.empty())
        report_.warning_despite_quiet(
            fmt::format("{} is missing; the run continues from {} to write it", lost.front(), path));
      report_.note(fmt::format("resumed {} at step {}", path, simulation_.state().step));
      return true;
    }
    if (!lost.empty())
      report_.warning_despite_quiet(fmt::format("{} is missing; the run starts again to write it", lost.front()));
    else if (!damage.empty())
      throw InputError(
          fmt::format("{}; no earlier checkpoint can be used: run without --resume to start again", damage));
    must_start_again_ = restored_;
    return false;
  }

  /// Restores a checkpoint. False if the run cannot continue from it. Missing checkpoints that it counts as written are
  /// added to `lost`.
  bool restore(const std::string& path, std::vector<std::string>& lost) {
    const bool rolling = path == checkpoint_path(options_.output);
    restored_ = true;
    record_ = {};
    mpfem::resume(path, simulation_, record_, ranks_);
    if (options_.from && !record_.from.empty() && record_.from != identity_.from)
      throw InputError(fmt::format(
          "{}: the checkpoint belongs to a run that did not begin at {}; run without --resume to start again", path,
          one_line(*options_.from)));
    const auto missing = leader_lists(ranks_, [this] { return missing_checkpoints(promised_now(), itself()); });
    lost.insert(lost.end(), missing.begin(), missing.end());
    if (!missing.empty()) return false;
    for (const std::string& part : leader_lists(ranks_, [this] { return missing_snapshots(); })) {
      if (!rolling || !lost.empty()) return false;
      throw InputError(fmt::format(
          "{}: the snapshot {}, taken before this checkpoint, is missing; run without --resume to start again", path,
          part));
    }
    if (!record_.history.empty()) first_step_ = static_cast<std::int64_t>(record_.history.front().step);
    return true;
  }

  /// Files of snapshots that have been taken and are no longer there.
  std::vector<std::string> missing_snapshots() const {
    std::vector<std::string> missing;
    for (const std::string& name : record_.snapshot_files)
      if (!std::filesystem::exists(snapshot_path(name))) missing.push_back(snapshot_path(name));
    return missing;
  }

  /// Checkpoints of stages and densities that must have been written by now.
  std::vector<std::string> promised_now() const {
    const double start =
        record_.history.empty() ? simulation_.relative_density() : record_.history.front().relative_density;
    return promised_checkpoints(scenario_, options_.output, simulation_.state().stage, simulation_.stage_complete(),
                                record_.checkpoints_passed, start);
  }

  /// Before a run is called complete: files that it has written may have been removed meanwhile.
  void check_promises() const {
    if (const auto missing = missing_checkpoints(promised_now(), itself()); !missing.empty())
      throw StorageError(fmt::format("{}: the run has written this file, but it is gone; --resume writes it again",
                                     one_line(missing.front())));
  }

  bool rolling_checkpoint_exists() const {
    return std::filesystem::exists(checkpoint_path(options_.output)) ||
           std::filesystem::exists(previous_checkpoint_path(options_.output));
  }

  /// Removes the files of an earlier, unfinished run of this name: they would mix with those of this run.
  void drop_unfinished_run() const {
    const std::string rolling = checkpoint_path(options_.output);
    if (std::filesystem::exists(rolling))
      report_.note(fmt::format("discarding {} of an unfinished run, because this run starts again (--resume would have "
                               "continued it)",
                               rolling));
    remove_unfinished(options_.output);
  }

  /// True if the output is the finished run of this very scenario and packing, from this beginning (if one is named),
  /// and all its checkpoints exist. Missing ones are added to `lost`.
  bool is_complete(std::vector<std::string>& lost) const {
    if (!std::filesystem::exists(options_.output)) return false;
    const RunSummary run = read_run_summary(options_.output);
    if (run.status != "complete" || run.scenario_text != scenario_.text || run.packing_hash != identity_.packing_hash ||
        (options_.from && !run.from.empty() && run.from != identity_.from))
      return false;
    RunIdentity itself = identity_;
    itself.from = run.from;
    lost = missing_checkpoints(promised_checkpoints(scenario_, options_.output, run.first_density, run.largest_density),
                               itself);
    return lost.empty();
  }

  /// Runs to the end of the last stage (true), or to a checkpoint after which the grains have new owners (false).
  bool loop() {
    for (;;) {
      simulation_.evaluate_forces();
      if (simulation_.stage_run().loading_rate().at_slowest)
        report_.slowest_speed(simulation_.stage().name, simulation_.relative_density());
      const bool stage_end = simulation_.stage_complete();
      const std::int64_t rows = record_.rows_in_stage;
      if (stage_end || row_due()) record_row();
      take_snapshots(stage_end, rows);
      if (stage_end) {
        record_.stages.push_back(simulation_.stage_result());
        report_.stage_end(record_.stages.back(), record_.history, simulation_.stage().damping.rate != 0);
        if (simulation_.state().stage + 1 == static_cast<std::int64_t>(scenario_.stages.size())) return true;
        begin_next_stage();
      }
      simulation_.advance();
      save_checkpoints();
      if (new_owners_) return false;
      report_progress();
    }
  }

  /// The stage before may have destroyed what this stage needs. That is a failure of the run, whose state is saved.
  void begin_next_stage() {
    try {
      simulation_.begin_next_stage();
      record_.rows_in_stage = 0;
    } catch (const InputError& error) {
      throw SimulationError(error.what());
    }
  }

  RunPosition position() const {
    return {simulation_.state().step, simulation_.relative_density(), simulation_.box().mean_stress()};
  }

  bool row_due() const {
    const StageRun& stage = simulation_.stage_run();
    return stage.state().time >=
           next_row_time(stage.expected_duration(), record_.rows_in_stage, scenario_.output.history_rows);
  }

  void record_row() {
    const auto start = Profile::Clock::now();
    record_.history.push_back(simulation_.observe());
    simulation_.reset_energy_balance(record_.history.back());
    const std::vector<ToolRow> tools = observe_tools(simulation_.tools());
    record_.tool_history.insert(record_.tool_history.end(), tools.begin(), tools.end());
    do ++record_.rows_in_stage;
    while (row_due() && simulation_.stage_run().expected_duration() > 0);
    simulation_.profile().add_serial(Part::output, Profile::since(start));
    report_.row(record_.history, {.rows_in_stage = record_.rows_in_stage,
                                  .rows_expected = scenario_.output.history_rows,
                                  .ends_stage = simulation_.stage_complete(),
                                  .controlled_by_contact = simulation_.step_estimate().state().controlled_by_contact,
                                  .nanoseconds = nanoseconds_per_tet_step()});
    const HistoryRow& row = record_.history.back();
    report_.energy_error(energy_check_->require(row), row.step);
  }

  /// `rows_before`: in the stage, at the step before.
  void take_snapshots(bool stage_end, std::int64_t rows_before) {
    const OutputParameters& output = scenario_.output;
    const auto& densities = output.snapshot_relative_densities;
    auto& passed = record_.snapshots_passed;
    bool due = stage_end ? output.snapshot_at_stage_end
                         : snapshot_due(rows_before, record_.rows_in_stage, output.history_rows,
                                        simulation_.stage().snapshots);
    while (passed < static_cast<std::int64_t>(densities.size()) &&
           simulation_.relative_density() >= densities[static_cast<std::size_t>(passed)] * (1 - 1e-9)) {
      ++passed;
      due = true;
    }
    if (due) save_snapshot();
  }

  void save_snapshot() {
    const auto start = Profile::Clock::now();
    leader_does(ranks_, [this] { std::filesystem::create_directories(parts_folder(options_.output)); });
    const std::string name = snapshot_name(record_.snapshot_files.size());
    const RunState& state = simulation_.state();
    write_snapshot_file(snapshot_path(name),
                        {simulation_.model(), simulation_.contact(), simulation_.box(), simulation_.wall_friction(),
                         simulation_.tools(), state.time, state.step, simulation_.relative_density()},
                        ranks_);
    record_.snapshot_files.push_back(name); // the name alone: a run may be resumed from another folder
    simulation_.profile().add_serial(Part::output, Profile::since(start));
  }

  /// Why a checkpoint is due although no stage or density requires one; the largest reason of all ranks counts.
  enum class Reason : int { none, interval, out_of_time, interrupted };

  Reason reason_for_checkpoint() const {
    Reason own = Reason::none;
    if (interrupt_requested())
      own = Reason::interrupted;
    else if (options_.time_limit > 0 && Profile::since(start_) > options_.time_limit)
      own = Reason::out_of_time;
    else if (Profile::since(last_checkpoint_) >= scenario_.output.checkpoint_interval)
      own = Reason::interval;
    return static_cast<Reason>(static_cast<int>(ranks_.largest(static_cast<int>(own))));
  }

  void save_checkpoints() {
    const bool stage_end = simulation_.stage_complete();
    const Reason reason = reason_for_checkpoint();
    const std::vector<double> passed = pass_densities();
    for (const double density : passed) save_checkpoint(density_checkpoint_path(options_.output, density));
    if (!stage_end && reason == Reason::none && passed.empty()) return;
    const auto start = Profile::Clock::now();
    if (stage_end)
      save_checkpoint(stage_checkpoint_path(
          options_.output, scenario_.stages[static_cast<std::size_t>(simulation_.state().stage)].name));
    // Last: it counts as done the stages and densities whose checkpoints are on disk by now.
    replace_rolling_checkpoint(ranks_, options_.output, [this](const std::string& path) { save_checkpoint(path); });
    last_checkpoint_ = Profile::Clock::now();
    simulation_.profile().add_serial(Part::output, Profile::since(start));
    if (reason == Reason::interval) balance();
    if (reason == Reason::none || reason == Reason::interval) return;
    write_result("interrupted");
    throw Interrupted(fmt::format("{} at step {}, relative density {:.4f}; continue with --resume",
                                  reason == Reason::interrupted ? "interrupted" : "stopped by --time-limit",
                                  simulation_.state().step, simulation_.relative_density()));
  }

  /// If ranks have unequal work and it pays, finds new owners for the grains. Times of a few steps are mostly those of
  /// other programs.
  void balance() {
    constexpr std::int64_t steps_worth_measuring = 200;
    const std::int64_t step = simulation_.state().step;
    if (ranks_.alone() || step - measured_from_step_ < steps_worth_measuring) return;
    measured_from_step_ = step;
    double busy = 0;
    for (const Part part : {Part::elements, Part::contact, Part::integration, Part::surface})
      busy += simulation_.profile().seconds(part);
    const Balance balance = measure_balance(ranks_, simulation_.model(), busy - busy_before_);
    busy_before_ = busy;
    const double done = fraction_done();
    const double remaining = done > done_at_start_ ? Profile::since(start_) * (1 - done) / (done - done_at_start_) : 0;
    if (!leader_finds(ranks_, [&] { return pays(balance, remaining, reload_seconds_); })) return;
    new_owners_ = redistribute(ranks_, simulation_.model(), balance);
    report_.note(fmt::format("the busiest rank has {:.0f} % more work than the mean: redistributing grains",
                             100 * (balance.imbalance - 1)));
  }

  /// Densities of output.checkpoint_relative_densities that the packing has now passed for the first time.
  std::vector<double> pass_densities() {
    const auto& densities = scenario_.output.checkpoint_relative_densities;
    auto& count = record_.checkpoints_passed;
    std::vector<double> passed;
    while (count < static_cast<std::int64_t>(densities.size()) &&
           simulation_.relative_density() >= densities[static_cast<std::size_t>(count)] * (1 - 1e-9))
      passed.push_back(densities[static_cast<std::size_t>(count++)]);
    return passed;
  }

  void save_checkpoint(const std::string& path) {
    RunRecord record = record_;
    add_times(record);
    mpfem::save_checkpoint(path, simulation_, record, ranks_);
  }

  /// Adds this process's share of wall-clock time to what earlier parts of the run took.
  void add_times(RunRecord& record) const {
    record.wall_time += Profile::since(start_);
    for (std::size_t i = 0; i < profile_parts; ++i)
      record.profile_seconds[i] += simulation_.profile().seconds(static_cast<Part>(i));
  }

  void write_result(const std::string& status) {
    RunRecord record = record_;
    add_times(record);
    Provenance provenance{scenario_.text,
                          status,
                          options_.threads,
                          ranks_.size(),
                          record.wall_time,
                          {},
                          {},
                          record_.stages,
                          {scenario_.has_friction(), scenario_.container.has_value()},
                          record_.from};
    for (PartTime& part : part_times(record.profile_seconds, record.wall_time)) {
      provenance.profile_name.push_back(std::move(part.name));
      provenance.profile_seconds.push_back(part.seconds);
    }
    std::vector<std::string> snapshots;
    for (const std::string& name : record_.snapshot_files) snapshots.push_back(snapshot_path(name));
    const RunHistory history{record_.history, simulation_.tools(), record_.tool_history};
    write_run_file(options_.output, simulation_.model(), history, snapshots, provenance, ranks_);
  }

  static std::string snapshot_name(std::size_t number) { return fmt::format("snapshot-{:04}.h5", number); }
  std::string snapshot_path(const std::string& name) const { return parts_folder(options_.output) + "/" + name; }

  double nanoseconds_per_tet_step() const {
    const auto steps = static_cast<double>(simulation_.state().step - steps_at_start_);
    return steps > 0 ? 1e9 * Profile::since(start_) / (steps * static_cast<double>(simulation_.model().tets())) : 0.0;
  }

  double fraction_done() const {
    const RunState& state = simulation_.state();
    const double of_present = simulation_.stage_run().fraction_done(simulation_.box().mean_stress());
    double done = 0, all = 0; // of the stages from the one with which this process began, by expected time
    for (std::size_t i = 0; i < expected_.size(); ++i) {
      const std::int64_t stage = first_expected_ + static_cast<std::int64_t>(i);
      all += expected_[i].duration;
      done += expected_[i].duration * (stage < state.stage ? 1.0 : stage == state.stage ? of_present : 0.0);
    }
    return all > 0 ? done / all : 0.0;
  }

  void report_progress() {
    if (simulation_.state().step % 16 != 0) return;
    report_.stable_step(simulation_.step_estimate().stable_step());
    report_.progress(fraction_done(), position());
  }

  void report_profile() const {
    RunRecord record = record_;
    add_times(record);
    const auto steps = static_cast<double>(simulation_.state().step - first_step_);
    report_.profile(part_times(record.profile_seconds, record.wall_time), record.wall_time,
                    steps * static_cast<double>(simulation_.model().tets()));
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  const Communicator& ranks_;
  Profile::Clock::time_point made_;
  ThreadTeam team_;
  Simulation simulation_;
  RunReport report_;
  std::optional<EnergyCheck> energy_check_;
  RunRecord record_;
  Profile::Clock::time_point start_, last_checkpoint_;
  std::int64_t steps_at_start_ = 0;
  std::vector<StageForecast> expected_; ///< of the stages from first_expected_ on
  std::int64_t first_expected_ = 0;
  std::int64_t first_step_ = 0;         ///< steps that the checkpoint of --from had done
  double reload_seconds_ = 0;           ///< that reading and preparing took
  double done_at_start_ = 0;            ///< fraction of the run
  double busy_before_ = 0;              ///< s, at the last look at the balance of ranks
  std::int64_t measured_from_step_ = 0; ///< the step of that look
  Owners new_owners_;
  RunIdentity identity_;
  bool already_complete_ = false, starts_again_ = false;
  bool restored_ = false;         ///< a checkpoint has replaced the state of the simulation
  bool must_start_again_ = false; ///< nothing that could be resumed is usable
};

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
    Runner runner(scenario, options, ranks, owners);
    const RunEnd end = runner.run();
    if (end == RunEnd::complete) return;
    options.resume = end == RunEnd::redistributed;
    owners = runner.new_owners();
    if (options.time_limit > 0) options.time_limit = std::max(options.time_limit - runner.age(), 1e-9);
  }
}

} // namespace mpfem
