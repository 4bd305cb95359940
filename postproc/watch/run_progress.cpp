#include "postproc/watch/run_progress.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include <sys/stat.h>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/run_stem.hpp"
#include "common/table_reader.hpp"
#include "postproc/run_data/history_table.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

namespace {

namespace check = schema::checkpoint;
namespace run = schema::run;

/// When a file was last written (s, system clock); empty where there is none.
std::optional<double> time_written(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  return static_cast<double>(found.st_mtim.tv_sec) + 1e-9 * static_cast<double>(found.st_mtim.tv_nsec);
}

/// Reads the system's list of locks; requesting the lock itself could stop a run that is starting. The number of the
/// device is not compared: overlay and other layered file systems list another one than stat() returns.
AtWork at_work(const std::string& lock) {
  struct stat found {};
  if (stat(lock.c_str(), &found) != 0) return AtWork::no;
  std::ifstream locks("/proc/locks");
  const std::string inode = fmt::format(":{} ", found.st_ino); // number: kind mode type process major:minor:inode …
  for (std::string line; std::getline(locks, line);)
    if (line.find(" FLOCK ") != std::string::npos && line.find(inode) != std::string::npos) return AtWork::yes;
  return AtWork::unknown;
}

RunPlan plan_of(const std::string& scenario) {
  RunPlan plan;
  try {
    const TomlDocument document = TomlDocument::from_text(scenario, "scenario");
    plan.history_rows = static_cast<int>(document.root().at_path("output.history_rows").value_or(plan.history_rows));
    const toml::array* stages = document.root()["stages"].as_array();
    for (std::size_t i = 0; stages && i < stages->size(); ++i) {
      const toml::table* table = (*stages)[i].as_table();
      const std::string type = table ? (*table)["type"].value_or(std::string()) : std::string();
      plan.stages.push_back({table ? (*table)["name"].value_or(fmt::format("{}-{}", type, i + 1)) : "", type});
    }
  } catch (const InputError&) { // a scenario of another version: stages go by their numbers
    return {};
  }
  return plan;
}

ProgressRow progress_row(const run::HistoryRow& row) {
  return {.stage = row.stage,
          .step = row.step,
          .time = row.time,
          .relative_density = row.relative_density,
          .mean_stress = row.mean_stress,
          .deviatoric_stress = row.deviatoric_stress,
          .time_step = row.time_step,
          .kinetic = row.kinetic_energy,
          .stored = row.elastic_energy + row.bond_energy + row.contact_energy + row.friction_energy,
          .dissipated = row.plastic_dissipation + row.damage_dissipation + row.friction_dissipation,
          .external_work = row.external_work,
          .residual = row.energy_residual,
          .penetration = row.max_penetration};
}

std::vector<ProgressRow> rows_of_checkpoint(const schema::FileReader& file) {
  static_assert(sizeof(run::HistoryRow) % sizeof(double) == 0);
  constexpr std::size_t columns = sizeof(run::HistoryRow) / sizeof(double);
  const std::vector<double> values = file.read(check::run_history);
  if (values.size() % columns != 0)
    throw InputError(fmt::format("{}: the checkpoint was written by a version of mpfem with other history columns",
                                 shown_path(file.path())));
  std::vector<ProgressRow> rows;
  for (std::size_t i = 0; i < values.size(); i += columns) {
    run::HistoryRow row{};
    std::memcpy(&row, &values[i], sizeof row);
    rows.push_back(progress_row(row));
  }
  return rows;
}

std::vector<ProgressRow> rows_of_run(const schema::FileReader& file) {
  const HistoryTable history(file, NotFinite::kept); // a run that diverged is shown too
  const bool friction = history.has("friction_energy");
  std::vector<ProgressRow> rows;
  for (std::size_t i = 0; i < history.rows(); ++i) {
    const auto of = [&](std::string_view name) { return history[name][i]; };
    rows.push_back({.stage = of("stage"),
                    .step = of("step"),
                    .time = of("time"),
                    .relative_density = of("relative_density"),
                    .mean_stress = of("mean_stress"),
                    .deviatoric_stress = of("deviatoric_stress"),
                    .time_step = of("time_step"),
                    .kinetic = of("kinetic_energy"),
                    .stored = of("elastic_energy") + of("bond_energy") + of("contact_energy") +
                              (friction ? of("friction_energy") : 0),
                    .dissipated = of("plastic_dissipation") + of("damage_dissipation") +
                                  (friction ? of("friction_dissipation") : 0),
                    .external_work = of("external_work"),
                    .residual = of("energy_residual"),
                    .penetration = of("max_penetration")});
  }
  return rows;
}

RunProgress progress_of_checkpoint(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::checkpoint);
  RunProgress progress;
  progress.plan = plan_of(file.read_scalar(check::scenario));
  progress.rows = rows_of_checkpoint(file);
  if (const auto integers = file.read(check::run_integers); !integers.empty()) // the first one is the step
    progress.step = static_cast<double>(integers.front());
  if (file.has(check::run_stage_end)) progress.stage_ends = file.read(check::run_stage_end);
  return progress;
}

RunProgress progress_of_run(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::run);
  RunProgress progress;
  progress.plan = plan_of(file.read_scalar(run::provenance_scenario));
  progress.rows = rows_of_run(file);
  progress.step = progress.rows.back().step;
  progress.status = file.read_scalar(run::provenance_status);
  return progress;
}

/// Uses the previous checkpoint; it is missing for a moment while a new one is written.
std::optional<double> seconds_per_stage(const RunProgress& now, const std::string& previous) {
  const auto written = time_written(previous);
  if (!written || now.rows.empty()) return {};
  try {
    const RunProgress before = progress_of_checkpoint(previous);
    if (before.rows.empty() || before.rows.back().stage != now.rows.back().stage) return {};
    const double gained = stage_share(now) - stage_share(before);
    if (!(gained > 0)) return {};
    return (now.written - *written) / gained;
  } catch (const InputError&) {
    return {};
  }
}

/// Empty where no file of the run holds a state yet. Throws InputError where one cannot be read.
std::optional<RunProgress> newest_state(const std::string& run_file) {
  const std::string rolling = name_of_checkpoint(run_file), previous = name_of_previous_checkpoint(run_file);
  const auto finished = time_written(run_file), lock = time_written(name_of_lock(run_file));
  const std::string checkpoint = time_written(rolling) ? rolling : previous;
  const auto saved = time_written(checkpoint);
  RunProgress progress;
  if (saved && (!finished || *saved > *finished)) {
    progress = progress_of_checkpoint(checkpoint);
    progress.file = checkpoint, progress.written = *saved;
    if (checkpoint == rolling) progress.seconds_per_stage = seconds_per_stage(progress, previous);
  } else if (finished && !(lock && *lock > *finished)) {
    progress = progress_of_run(run_file);
    progress.file = run_file, progress.written = *finished;
  } else if (!lock) {
    return {};
  }
  progress.at_work = at_work(name_of_lock(run_file));
  return progress;
}

} // namespace

RunProgress read_progress(const std::string& run_file) {
  constexpr int tries = 5; // a rename may happen between two accesses, but not every time
  for (int left = tries;; --left) {
    try {
      if (auto progress = newest_state(run_file)) return *std::move(progress);
      if (left == 0)
        throw InputError(fmt::format("{}: found neither this file nor a checkpoint nor a lock next to it, allowed: the "
                                     "--output of a run that has started",
                                     shown_path(run_file)));
    } catch (const InputError&) {
      if (left == 0) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

double stage_share(const RunProgress& progress) {
  const auto& rows = progress.rows;
  if (rows.empty()) return 0;
  const ProgressRow& last = rows.back();
  const auto first =
      std::find_if(rows.begin(), rows.end(), [&](const ProgressRow& r) { return r.stage == last.stage; });
  const auto whole = static_cast<double>(rows.end() - first - 1); // the first row is the beginning
  const double steps = last.step - first->step, since = progress.step - last.step;
  const double part = steps > 0 ? std::clamp(since * whole / steps, 0.0, 1.0) : 0.0;
  return (whole + part) / std::max(1, progress.plan.history_rows);
}

} // namespace mpfem
