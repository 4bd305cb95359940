#include "solver/run/run_scenario.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "common/available_memory.hpp"
#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "common/progress.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/history.hpp"
#include "solver/output/run_file.hpp"
#include "solver/output/run_lock.hpp"
#include "solver/run/energy_check.hpp"
#include "solver/run/needs.hpp"
#include "solver/run/plan_text.hpp"
#include "solver/run/programme.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

namespace {

/// Signals that follow each other within this time (s) are one request: batch systems send several at a time limit.
constexpr std::time_t one_request = 5;

volatile std::sig_atomic_t interrupt_requested = 0;
volatile std::sig_atomic_t requested_at = 0; // s
extern "C" void request_interrupt(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (interrupt_requested == 0) {
    requested_at = static_cast<std::sig_atomic_t>(now.tv_sec);
    interrupt_requested = 1;
  } else if (now.tv_sec - requested_at > one_request) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

/// Catches SIGINT and SIGTERM while it lives; a signal some seconds after the first acts as usual.
class InterruptGuard {
public:
  InterruptGuard() {
    interrupt_requested = 0;
    struct sigaction action {};
    action.sa_handler = request_interrupt;
    sigaction(SIGINT, &action, &old_int_);
    sigaction(SIGTERM, &action, &old_term_);
  }
  ~InterruptGuard() {
    if (interrupt_requested != 0) return; // the program ends; what comes late shall not change how
    sigaction(SIGINT, &old_int_, nullptr);
    sigaction(SIGTERM, &old_term_, nullptr);
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

private:
  struct sigaction old_int_ {
  }, old_term_{};
};

std::string stem(const std::string& run_file) {
  return run_file.ends_with(".h5") ? run_file.substr(0, run_file.size() - 3) : run_file;
}

std::string parts_folder(const std::string& run_file) {
  return stem(run_file) + ".parts";
}

/// "ended by axial strain 0.15; stresses held within 0.05 MPa (0.6 %)"
std::string stage_end_text(const StageResult& result) {
  std::string text = "ended by " + result.ended_by;
  if (result.overshoot > 0) text += fmt::format("; stress passed by {:.3g} MPa", result.overshoot);
  if (result.hold_stress > 0)
    text += fmt::format("; stresses held within {:.3g} MPa ({:.2g} %), {:.3g} MPa in the root mean square",
                        result.hold_error, 100 * result.hold_error / result.hold_stress, result.hold_rms);
  return text;
}

/// Young's modulus times volume, summed over all grains, mJ.
double stiffness_of(const Model& model) {
  double stiffness = 0;
  for (int grain = 0; grain < model.grains; ++grain)
    stiffness += model.material_of(grain).moduli.youngs() * model.reference_volume[static_cast<std::size_t>(grain)];
  return stiffness;
}

/// The time loop and its records.
class Runner {
public:
  Runner(const Scenario& scenario, const RunOptions& options)
      : scenario_(scenario), options_(options), team_(options.threads),
        simulation_(build_model(read_packing(scenario.packing_file), scenario, scenario.packing_file), scenario, team_,
                    options.from.has_value()),
        energy_check_(stiffness_of(simulation_.model())), progress_("mpfem", options.quiet) {
    const auto warnings = check_bonds(simulation_.model(), scenario_);
    begin();
    if (!options_.quiet && !already_complete_) {
      for (const std::string& warning : warnings) fmt::print(stderr, "mpfem: warning: {}\n", warning);
      if (const std::string text = mass_scaling_text(scenario_, simulation_.model()); !text.empty())
        fmt::print(stderr, "mpfem: {}\n", text);
      if (const std::string text = earlier_bonds_text(simulation_.contact()); !text.empty())
        fmt::print(stderr, "mpfem: {}\n", text);
    }
    const RunState& state = simulation_.state();
    check_programme(scenario_, state.stage, state.stage_low, state.stage_high, simulation_.model(), state.stable_step);
    for (const HistoryRow& row : record_.history) energy_check_.take(row);
    expected_ = forecast(scenario_, state.stage, state.stage_low, state.stage_high, simulation_.model());
    first_expected_ = state.stage;
    if (begins_anew_) pass_densities();
  }

  void run() {
    if (already_complete_) return;
    if (begins_anew_) drop_unfinished_run();
    const InterruptGuard guard;
    start_ = last_checkpoint_ = Profile::Clock::now();
    steps_at_start_ = simulation_.state().step;
    try {
      loop();
    } catch (const SimulationError& error) {
      // The failed state is worth looking at: a snapshot of it, and everything recorded so far.
      try {
        save_snapshot();
        write_result(fmt::format("failed: {}", error.what()));
      } catch (const StorageError& storage) {
        throw SimulationError(fmt::format("{}; and its state could not be saved: {}", error.what(), storage.what()));
      }
      throw SimulationError(fmt::format("{}; history and last state are in {}", error.what(), options_.output));
    }
    write_result("complete");
    remove_parts();
    progress_.finish(fmt::format("{} steps, D_r = {:.4f}, p = {:.4g} MPa, {}", simulation_.state().step,
                                 simulation_.relative_density(), simulation_.state().mean_stress, options_.output));
    if (!options_.quiet) print_profile();
  }

private:
  void begin() {
    const std::string rolling = checkpoint_path(options_.output);
    const std::string from = options_.from ? checkpoint_checksum(*options_.from) : "packing";
    if (options_.resume && std::filesystem::exists(rolling)) {
      read_checkpoint(rolling, simulation_, record_, scenario_.text, false);
      if (options_.from && !record_.from.empty() && record_.from != from)
        throw InputError(fmt::format("{}: the run did not begin at {}; run without --resume to begin anew", rolling,
                                     one_line(*options_.from)));
      if (!record_.history.empty()) first_step_ = static_cast<std::int64_t>(record_.history.front().step);
      for (const std::string& name : record_.snapshot_files)
        if (const std::string part = snapshot_path(name); !std::filesystem::exists(part))
          throw InputError(fmt::format(
              "{}: the snapshot {} that was taken before the checkpoint is missing; run without --resume to begin anew",
              rolling, part));
      if (!options_.quiet) fmt::print(stderr, "mpfem: resumed {} at step {}\n", rolling, simulation_.state().step);
      return;
    }
    if (options_.resume && is_complete(from)) {
      already_complete_ = true;
      if (!options_.quiet) fmt::print(stderr, "mpfem: {} is complete already\n", options_.output);
      return;
    }
    if (options_.from) {
      begin_branch(*options_.from, simulation_, scenario_.text);
      first_step_ = simulation_.state().step;
    }
    record_.from = from;
    begins_anew_ = true;
  }

  /// What an earlier, unfinished run of this name left would mix with what this one writes.
  void drop_unfinished_run() const {
    const std::string rolling = checkpoint_path(options_.output);
    if (!options_.quiet && std::filesystem::exists(rolling))
      fmt::print(stderr,
                 "mpfem: {} of an unfinished run is dropped: this run begins anew (--resume would have gone on)\n",
                 rolling);
    remove_parts();
  }

  /// True where the output is the finished run of this very scenario and packing, from this beginning (where one is
  /// asked for).
  bool is_complete(const std::string& from) const {
    if (!std::filesystem::exists(options_.output)) return false;
    const schema::FileReader file(options_.output, schema::FileKind::run);
    return file.read_scalar(schema::run::provenance_status) == "complete" &&
           file.read_scalar(schema::run::provenance_scenario) == scenario_.text &&
           file.read_scalar(schema::run::provenance_packing_hash) == hash_text(simulation_.model().mesh_hash) &&
           (!options_.from || !file.has(schema::run::provenance_from) ||
            file.read_scalar(schema::run::provenance_from) == from);
  }

  void loop() {
    for (;;) {
      simulation_.evaluate_forces();
      RunState& state = simulation_.state();
      warn_of_slowest_speed();
      const bool stage_end = simulation_.stage_complete();
      if (stage_end || row_due()) record_row();
      take_snapshots(stage_end);
      if (stage_end) {
        report_stage_end();
        if (state.stage + 1 == static_cast<std::int64_t>(scenario_.stages.size())) return;
        ++state.stage;
        simulation_.begin_stage();
      }
      simulation_.advance();
      save_checkpoints();
      report_progress();
    }
  }

  /// Once a stage: the tolerances ask for less speed than the scenario allows.
  void warn_of_slowest_speed() {
    const RunState& state = simulation_.state();
    if (state.pace.at_slowest == 0 || warned_of_stage_ == state.stage) return;
    warned_of_stage_ = state.stage;
    if (!options_.quiet)
      fmt::print(stderr,
                 "mpfem: warning: stage '{}', D_r = {:.4f}: tolerances of quasi_static are not met with slowest_speed "
                 "either\n",
                 simulation_.stage().name, simulation_.relative_density());
  }

  void report_stage_end() {
    const StageResult result = simulation_.stage_result();
    record_.stages.push_back(result);
    if (!options_.quiet)
      fmt::print(stderr, "mpfem: stage '{}' {}{}\n", result.name, stage_end_text(result), damping_text());
  }

  /// What mass-proportional damping took in the stage that ends, beside the energy that it must leave alone. It gives where it
  /// drags grains along with the walls.
  std::string damping_text() const {
    if (simulation_.stage().damping.rate == 0) return {};
    const auto stage = static_cast<double>(simulation_.state().stage);
    double before = 0, elastic = 0;
    for (const HistoryRow& row : record_.history) {
      if (row.stage < stage) before = row.damping_dissipation;
      if (row.stage == stage) elastic = std::max(elastic, row.elastic_energy);
    }
    const double taken = record_.history.back().damping_dissipation - before;
    if (!(elastic > 0)) return {};
    return fmt::format("; damping {} {:.2g} % of the elastic energy", taken < 0 ? "gave" : "took",
                       100 * std::abs(taken) / elastic);
  }

  double next_row_time() const {
    return simulation_.stage_duration() * static_cast<double>(simulation_.state().rows_in_stage) /
           scenario_.output.history_rows;
  }
  bool row_due() const { return simulation_.state().stage_time >= next_row_time(); }

  void record_row() {
    const auto start = Profile::Clock::now();
    record_.history.push_back(simulation_.observe());
    RunState& state = simulation_.state();
    do ++state.rows_in_stage;
    while (row_due() && simulation_.stage_duration() > 0);
    simulation_.profile().add_serial(Part::output, Profile::since(start));
    if (!options_.quiet) report_row(record_.history.back());
    check_energy(record_.history.back());
  }

  /// Fails where the energy balance is so far off that the run means nothing any more; warns, once, where it may matter.
  void check_energy(const HistoryRow& row) {
    const double error = energy_check_.take(row);
    if (!(error <= EnergyCheck::allowed))
      throw SimulationError(fmt::format(
          "step {:.0f}, t = {:.4g} s, D_r = {:.4f}: the energy balance is off by {:.3g} % of its largest term, allowed "
          "{:g} %: the motion is not computed stably; lower numerics.time_step_factor, or the speed",
          row.step, row.time, row.relative_density, 100 * error, 100 * EnergyCheck::allowed));
    if (error <= EnergyCheck::noteworthy || warned_of_energy_ || options_.quiet) return;
    warned_of_energy_ = true;
    fmt::print(stderr, "mpfem: warning: the energy balance is off by {:.2g} % of its largest term at step {:.0f}\n",
               100 * error, row.step);
  }

  void take_snapshots(bool stage_end) {
    RunState& state = simulation_.state();
    const auto& densities = scenario_.output.snapshot_relative_densities;
    bool due = stage_end && scenario_.output.snapshot_at_stage_end;
    while (state.snapshots_passed < static_cast<std::int64_t>(densities.size()) &&
           simulation_.relative_density() >= densities[static_cast<std::size_t>(state.snapshots_passed)] * (1 - 1e-9)) {
      ++state.snapshots_passed;
      due = true;
    }
    if (due) save_snapshot();
  }

  void save_snapshot() {
    const auto start = Profile::Clock::now();
    std::filesystem::create_directories(parts_folder(options_.output));
    const std::string name = snapshot_name(record_.snapshot_files.size());
    write_snapshot_file(snapshot_path(name), simulation_);
    record_.snapshot_files.push_back(name); // the name alone: a run may be resumed from another folder
    simulation_.profile().add_serial(Part::output, Profile::since(start));
  }

  void save_checkpoints() {
    const bool stage_end = simulation_.stage_complete();
    const bool interrupted = interrupt_requested != 0;
    const std::vector<double> passed = pass_densities();
    const bool out_of_time = options_.time_limit > 0 && Profile::since(start_) > options_.time_limit;
    for (const double density : passed) save_checkpoint(density_checkpoint_path(options_.output, density));
    if (!stage_end && !interrupted && !out_of_time && passed.empty() &&
        Profile::since(last_checkpoint_) < scenario_.output.checkpoint_interval)
      return;
    const auto start = Profile::Clock::now();
    save_checkpoint(checkpoint_path(options_.output));
    if (stage_end)
      save_checkpoint(stage_checkpoint_path(
          options_.output, scenario_.stages[static_cast<std::size_t>(simulation_.state().stage)].name));
    last_checkpoint_ = Profile::Clock::now();
    simulation_.profile().add_serial(Part::output, Profile::since(start));
    if (interrupted || out_of_time) {
      write_result("interrupted");
      throw Interrupted(fmt::format("{} at step {}, D_r = {:.4f}; go on with --resume",
                                    interrupted ? "interrupted" : "out of time", simulation_.state().step,
                                    simulation_.relative_density()));
    }
  }

  /// Densities of output.checkpoint_relative_densities that the packing has now passed for the first time.
  std::vector<double> pass_densities() {
    const auto& densities = scenario_.output.checkpoint_relative_densities;
    auto& count = simulation_.state().checkpoints_passed;
    std::vector<double> passed;
    while (count < static_cast<std::int64_t>(densities.size()) &&
           simulation_.relative_density() >= densities[static_cast<std::size_t>(count)] * (1 - 1e-9))
      passed.push_back(densities[static_cast<std::size_t>(count++)]);
    return passed;
  }

  void save_checkpoint(const std::string& path) {
    RunRecord record = record_;
    add_times(record);
    write_checkpoint(path, simulation_, record, scenario_.text);
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
    Provenance provenance{scenario_.text, status,      options_.threads, record.wall_time, {}, {},
                          record_.stages, record_.from};
    double accounted = 0;
    for (std::size_t i = 0; i < profile_parts; ++i) {
      provenance.profile_name.emplace_back(part_names[i]);
      provenance.profile_seconds.push_back(record.profile_seconds[i]);
      accounted += record.profile_seconds[i];
    }
    provenance.profile_name.emplace_back("waiting and rest");
    provenance.profile_seconds.push_back(record.wall_time - accounted);
    std::vector<std::string> snapshots;
    for (const std::string& name : record_.snapshot_files) snapshots.push_back(snapshot_path(name));
    write_run_file(options_.output, simulation_.model(), record_.history, snapshots, provenance);
  }

  static std::string snapshot_name(std::size_t number) { return fmt::format("snapshot-{:04}.h5", number); }
  std::string snapshot_path(const std::string& name) const { return parts_folder(options_.output) + "/" + name; }

  /// Removes the run's own files only; the folder goes if nothing else is in it.
  void remove_parts() const {
    std::error_code ignored;
    for (std::size_t number = 0; std::filesystem::remove(snapshot_path(snapshot_name(number)), ignored); ++number) {
    }
    std::filesystem::remove(parts_folder(options_.output), ignored);
    std::filesystem::remove(checkpoint_path(options_.output), ignored);
  }

  double nanoseconds_per_tet_step() const {
    const auto steps = static_cast<double>(simulation_.state().step - steps_at_start_);
    return steps > 0 ? 1e9 * Profile::since(start_) / (steps * static_cast<double>(simulation_.model().tets())) : 0.0;
  }

  double fraction_done() const {
    const RunState& state = simulation_.state();
    double done = 0, all = 0; // of the stages from the one with which this process began, by expected time
    for (std::size_t i = 0; i < expected_.size(); ++i) {
      const std::int64_t stage = first_expected_ + static_cast<std::int64_t>(i);
      all += expected_[i].duration;
      done += expected_[i].duration * (stage < state.stage    ? 1.0
                                       : stage == state.stage ? simulation_.stage_fraction_done()
                                                              : 0.0);
    }
    return all > 0 ? done / all : 0.0;
  }

  void report_progress() {
    const RunState& state = simulation_.state();
    if (state.step % 16 != 0) return;
    progress_.update(fraction_done(),
                     fmt::format("step {}  D_r {:.4f}  p {:.4g} MPa  {:.0f} ns/tet-step", state.step,
                                 simulation_.relative_density(), state.mean_stress, nanoseconds_per_tet_step()));
  }

  /// Fixed-width report lines, twenty a stage.
  void report_row(const HistoryRow& row) {
    const std::int64_t every = std::max(1, scenario_.output.history_rows / 20);
    if ((simulation_.state().rows_in_stage - 1) % every != 0 && !simulation_.stage_complete()) return;
    if (reported_lines_++ % 20 == 0)
      fmt::print(stderr, "{:>8} {:>10} {:>10} {:>8} {:>7} {:>9} {:>9} {:>8} {:>9} {:>7} {:>8}\n", "step", "t/us",
                 "dt/ns", "limit", "D_r", "p/MPa", "q/MPa", "KE/IE", "residual", "pen/h", "ns/tet");
    const double internal = row.elastic_energy + row.plastic_dissipation;
    fmt::print(stderr,
               "{:>8.0f} {:>10.4f} {:>10.4f} {:>8} {:>7.4f} {:>9.4g} {:>9.3g} {:>8} {:>9.2e} {:>7.4f} {:>8.1f}\n",
               row.step, row.time * 1e6, row.time_step * 1e9,
               simulation_.state().controlled_by_contact ? "contact" : "element", row.relative_density, row.mean_stress,
               row.deviatoric_stress,
               row.kinetic_energy < 1e3 * internal ? fmt::format("{:.2e}", row.kinetic_energy / internal) : "-",
               row.external_work > 0 ? row.energy_residual / row.external_work : 0.0, row.max_penetration,
               nanoseconds_per_tet_step());
  }

  void print_profile() const {
    RunRecord record = record_;
    add_times(record);
    fmt::print(stderr, "{:<24} {:>10} {:>8} {:>12}\n", "part", "wall s", "share", "ns/tet-step");
    const double tet_steps =
        static_cast<double>(simulation_.state().step - first_step_) * static_cast<double>(simulation_.model().tets());
    double accounted = 0;
    const auto line = [&](const char* name, double seconds) {
      fmt::print(stderr, "{:<24} {:>10.2f} {:>7.1f}% {:>12.2f}\n", name, seconds, 100 * seconds / record.wall_time,
                 1e9 * seconds / tet_steps);
    };
    for (std::size_t i = 0; i < profile_parts; ++i) {
      line(part_names[i], record.profile_seconds[i]);
      accounted += record.profile_seconds[i];
    }
    line("waiting and rest", record.wall_time - accounted);
    line("total", record.wall_time);
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  ThreadTeam team_;
  Simulation simulation_;
  EnergyCheck energy_check_;
  Progress progress_;
  RunRecord record_;
  Profile::Clock::time_point start_, last_checkpoint_;
  std::int64_t steps_at_start_ = 0;
  std::vector<StageForecast> expected_; ///< of the stages from first_expected_ on
  std::int64_t first_expected_ = 0;
  std::int64_t warned_of_stage_ = -1;
  std::int64_t first_step_ = 0; ///< steps that the checkpoint of --from had done
  int reported_lines_ = 0;
  bool already_complete_ = false, begins_anew_ = false, warned_of_energy_ = false;
};

bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return std::filesystem::equivalent(a, b, ignored) ||
         std::filesystem::weakly_canonical(a, ignored) == std::filesystem::weakly_canonical(b, ignored);
}

/// Refuses to write over what the run reads, and finds out now whether it can write at all.
void check_output(const Scenario& scenario, const RunOptions& options) {
  const std::string& output = options.output;
  std::error_code ignored;
  if (output.empty() || output.back() == '/' || std::filesystem::is_directory(output, ignored))
    throw InputError(
        fmt::format("--output '{}': found a folder or nothing, allowed the name of a file", one_line(output)));
  if (!std::filesystem::is_directory(std::filesystem::absolute(output).parent_path(), ignored))
    throw InputError(fmt::format("--output {}: the folder does not exist", one_line(output)));
  const auto refuse = [&](const std::string& file, const std::string& what) {
    if (same_file(output, file))
      throw InputError(fmt::format("--output {}: is {} of this run, allowed another name", one_line(output), what));
  };
  refuse(scenario.packing_file, "the packing");
  refuse(options.scenario_file, "the scenario");
  if (options.from) {
    refuse(*options.from, "the checkpoint to start from");
    std::vector<std::string> written{checkpoint_path(output)};
    for (const Stage& stage : scenario.stages) written.push_back(stage_checkpoint_path(output, stage.name));
    for (const double density : scenario.output.checkpoint_relative_densities)
      written.push_back(density_checkpoint_path(output, density));
    for (const std::string& path : written)
      if (same_file(path, *options.from))
        throw InputError(
            fmt::format("--from {}: this run would write its own checkpoint there, allowed another --output",
                        one_line(*options.from)));
  }
  const std::string trial = output + ".partial";
  if (!std::ofstream(trial)) throw StorageError(fmt::format("{}: cannot be written", one_line(trial)));
  std::filesystem::remove(trial, ignored);
}

} // namespace

std::string checkpoint_path(const std::string& run_file) {
  return stem(run_file) + ".checkpoint.h5";
}

std::string stage_checkpoint_path(const std::string& run_file, const std::string& stage) {
  return fmt::format("{}.{}.checkpoint.h5", stem(run_file), stage);
}

std::string density_checkpoint_path(const std::string& run_file, double relative_density) {
  return fmt::format("{}.D{:.3f}.checkpoint.h5", stem(run_file), relative_density);
}

void run_scenario(const Scenario& scenario, const RunOptions& options) {
  check_output(scenario, options);
  const std::string scarce = check_needs(options.output, needs_of(read_packing_counts(scenario.packing_file), scenario),
                                         {.memory = available_memory(), .disk = available_disk_space(options.output)});
  if (!scarce.empty() && !options.quiet) fmt::print(stderr, "mpfem: warning: {}\n", scarce);
  const RunLock lock(options.output);
  Runner(scenario, options).run();
}

} // namespace mpfem
