#include "solver/run/run_records.hpp"

#include <filesystem>

#include "common/errors.hpp"
#include "solver/output/run_file.hpp"
#include "solver/parallel/root.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/history_schedule.hpp"
#include "solver/run/observer.hpp"
#include "solver/run/resume.hpp"

namespace mpfem {

RunRecords::RunRecords(Simulation& simulation, RunRecord& record, const RunOptions& options)
    : scenario_(simulation.scenario()), simulation_(simulation), record_(record), options_(options),
      start_(Profile::Clock::now()) {}

bool RunRecords::row_is_due() const {
  const StageRun& stage = simulation_.stage_run();
  return stage.state().time >=
         next_row_time(stage.expected_duration(), record_.rows_in_stage, scenario_.output.history_rows);
}

const HistoryRow& RunRecords::add_row() {
  const auto start = Profile::Clock::now();
  record_.history.push_back(simulation_.observe());
  simulation_.reset_energy_balance(record_.history.back());
  const std::vector<ToolRow> tools = observe_tools(simulation_.tools());
  record_.tool_history.insert(record_.tool_history.end(), tools.begin(), tools.end());
  do ++record_.rows_in_stage; // a long step may pass the times of several rows
  while (row_is_due() && simulation_.stage_run().expected_duration() > 0);
  simulation_.profile().add_serial(Part::output, Profile::since(start));
  return record_.history.back();
}

/// The densities, in ascending order, that are reached after the first `passed` ones; adds their number to `passed`.
std::vector<double> RunRecords::pass(const std::vector<double>& densities, std::int64_t& passed) const {
  std::vector<double> now;
  while (passed < static_cast<std::int64_t>(densities.size()) &&
         simulation_.relative_density() >= densities[static_cast<std::size_t>(passed)] * (1 - 1e-9))
    now.push_back(densities[static_cast<std::size_t>(passed++)]);
  return now;
}

void RunRecords::take_snapshots(bool stage_end, std::int64_t rows_before) {
  const OutputParameters& output = scenario_.output;
  const bool due =
      stage_end ? output.snapshot_at_stage_end
                : snapshot_due(rows_before, record_.rows_in_stage, output.history_rows, simulation_.stage().snapshots);
  const bool passed = !pass(output.snapshot_relative_densities, record_.snapshots_passed).empty();
  if (due || passed) save_snapshot();
}

void RunRecords::save_snapshot() {
  const auto start = Profile::Clock::now();
  root_does(simulation_.ranks(), [this] { std::filesystem::create_directories(parts_folder(options_.output)); });
  const std::string name = snapshot_name(record_.snapshot_files.size());
  const RunState& state = simulation_.state();
  write_snapshot_file(snapshot_path(options_.output, name),
                      {simulation_.model(), simulation_.contact(), simulation_.box(), simulation_.wall_friction(),
                       simulation_.tools(), state.time, state.step, simulation_.relative_density()},
                      simulation_.ranks());
  record_.snapshot_files.push_back(name); // the name alone: a run may be resumed from another folder
  simulation_.profile().add_serial(Part::output, Profile::since(start));
}

const StageResult& RunRecords::end_stage() {
  return record_.stages.emplace_back(simulation_.stage_result());
}

std::vector<double> RunRecords::pass_checkpoint_densities() {
  return pass(scenario_.output.checkpoint_relative_densities, record_.checkpoints_passed);
}

void RunRecords::save_checkpoint(const std::string& path) const {
  mpfem::save_checkpoint(path, simulation_, with_times(), simulation_.ranks());
}

void RunRecords::write_result(const std::string& status) const {
  const RunRecord record = with_times();
  Provenance provenance{scenario_.text,
                        status,
                        options_.threads,
                        simulation_.ranks().size(),
                        record.wall_time,
                        {},
                        {},
                        record.stages,
                        {scenario_.has_friction(), scenario_.container.has_value()},
                        record.from};
  for (PartTime& part : part_times(record.profile_seconds, record.wall_time)) {
    provenance.profile_name.push_back(std::move(part.name));
    provenance.profile_seconds.push_back(part.seconds);
  }
  std::vector<std::string> snapshots;
  for (const std::string& name : record.snapshot_files) snapshots.push_back(snapshot_path(options_.output, name));
  const RunHistory history{record.history, simulation_.tools(), record.tool_history};
  try {
    write_run_file(options_.output, simulation_.model(), history, snapshots, provenance, simulation_.ranks());
  } catch (const InputError& error) { // of a snapshot file, which the run itself has written
    throw StorageError(error.what());
  }
}

RunRecord RunRecords::with_times() const {
  RunRecord record = record_;
  record.wall_time += Profile::since(start_);
  for (std::size_t i = 0; i < profile_parts; ++i)
    record.profile_seconds[i] += simulation_.profile().seconds(static_cast<Part>(i));
  return record;
}

} // namespace mpfem
