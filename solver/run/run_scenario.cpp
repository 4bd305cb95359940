#include "solver/run/run_scenario.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "common/available_memory.hpp"
#include "common/errors.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/run_file.hpp"
#include "solver/output/run_lock.hpp"
#include "solver/parallel/leader.hpp"
#include "solver/run/balance.hpp"
#include "solver/run/check_output.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/continuation.hpp"
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

/// The time loop of a prepared simulation, and its records.
class Runner {
public:
  /// `preparation`: s of wall-clock time that reading and preparing took.
  Runner(Simulation& simulation, RunRecord& record, const Continuation& continuation, RunReport& report,
         const RunOptions& options, double preparation)
      : scenario_(simulation.scenario()), options_(options), ranks_(simulation.ranks()), simulation_(simulation),
        report_(report), energy_check_(simulation.model(), record.history), record_(record),
        continuation_(continuation), start_(Profile::Clock::now()), last_checkpoint_(start_),
        steps_at_start_(simulation.state().step),
        expected_(
            forecast(scenario_, simulation.state().stage, simulation.stage_run().state().start, simulation.model())),
        first_expected_(simulation.state().stage), reload_seconds_(preparation), done_at_start_(fraction_done()),
        measured_from_step_(steps_at_start_) {}

  RunEnd run() {
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
    leader_does(ranks_, [this] { continuation_.check_written_checkpoints(); });
    write_result("complete");
    leader_does(ranks_, [this] { remove_unfinished(options_.output); });
    report_.finish(position(), options_.output);
    report_profile();
    report_.quality(record_.history);
    return RunEnd::complete;
  }

  /// After redistributed.
  const Owners& new_owners() const { return new_owners_; }

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

private:
  /// "; the last checkpoint before the failure is FILE", or that there is none.
  std::string last_checkpoint_text() const {
    const auto checkpoints = leader_lists(ranks_, [this] { return continuation_.resumable(); });
    return checkpoints.empty() ? "; there is no earlier checkpoint"
                               : fmt::format("; the last checkpoint before the failure is {}", checkpoints.front());
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
    report_.energy_error(energy_check_.require(row), row.step);
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
    write_snapshot_file(snapshot_path(options_.output, name),
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
    for (const std::string& name : record_.snapshot_files) snapshots.push_back(snapshot_path(options_.output, name));
    const RunHistory history{record_.history, simulation_.tools(), record_.tool_history};
    write_run_file(options_.output, simulation_.model(), history, snapshots, provenance, ranks_);
  }

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
    // A branch counts its own steps; a run that was resumed, those of all its parts.
    const double steps = record_.history.back().step - record_.history.front().step;
    report_.profile(part_times(record.profile_seconds, record.wall_time), record.wall_time,
                    steps * static_cast<double>(simulation_.model().tets()));
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  const Communicator& ranks_;
  Simulation& simulation_;
  RunReport& report_;
  EnergyCheck energy_check_;
  RunRecord& record_;
  const Continuation& continuation_;
  Profile::Clock::time_point start_, last_checkpoint_;
  std::int64_t steps_at_start_;
  std::vector<StageForecast> expected_; ///< of the stages from first_expected_ on
  std::int64_t first_expected_;
  double reload_seconds_;           ///< that reading and preparing took
  double done_at_start_;            ///< fraction of the run
  std::int64_t measured_from_step_; ///< the step of that look
  double busy_before_ = 0;          ///< s, at the last look at the balance of ranks
  Owners new_owners_;
};

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
  Runner runner(simulation, record, continuation, report, options, Profile::since(begun));
  if (beginning == Beginning::fresh) runner.pass_densities(); // those that the packing has from the start
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
