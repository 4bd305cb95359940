#include "solver/run/continuation.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "common/run_stem.hpp"
#include "solver/output/other_scenario.hpp"
#include "solver/output/run_file.hpp"
#include "solver/parallel/root.hpp"
#include "solver/run/resume.hpp"

namespace mpfem {

namespace {

namespace fs = std::filesystem;

bool rolling_checkpoint_exists(const std::string& run_file) {
  return fs::exists(name_of_checkpoint(run_file)) || fs::exists(name_of_previous_checkpoint(run_file));
}

/// Files of snapshots (`names`) that have been taken and are no longer there.
std::vector<std::string> missing_snapshots(const std::string& run_file, const std::vector<std::string>& names) {
  std::vector<std::string> missing;
  for (const std::string& name : names)
    if (!fs::exists(snapshot_path(run_file, name))) missing.push_back(snapshot_path(run_file, name));
  return missing;
}

/// Collective. What is wrong with a checkpoint; empty if it is intact.
std::string damage_of(const std::string& path, const Communicator& ranks) {
  try {
    root_does(ranks, [&] { verify_checkpoint(path); });
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

} // namespace

Continuation::Continuation(Simulation& simulation, RunRecord& record, const RunOptions& options,
                           const RunReport& report)
    : scenario_(simulation.scenario()), ranks_(simulation.ranks()), simulation_(simulation), record_(record),
      options_(options), report_(report) {}

Beginning Continuation::begin() {
  const std::string from = root_says(
      ranks_, [this] { return options_.from ? checkpoint_checksum(*options_.from) : std::string("packing"); });
  identity_ = {options_.output, scenario_.text, hash_text(simulation_.model().mesh_hash), from};
  if (options_.resume)
    if (const auto beginning = resume()) return *beginning;
  if (options_.from) begin_branch(*options_.from, simulation_, ranks_);
  record_.from = from;
  return Beginning::fresh;
}

/// None if nothing is there that could be continued.
std::optional<Beginning> Continuation::resume() {
  std::vector<std::string> lost; // checkpoints that should be on disk and are not
  if (found_complete(lost)) return Beginning::complete;
  std::string damage;
  if (restore_best(lost, damage)) return Beginning::resumed;
  if (!lost.empty())
    report_.warning(fmt::format("{} is missing; the run starts again to write it", lost.front()));
  else if (!damage.empty())
    throw InputError(fmt::format("{}; no earlier checkpoint can be used: run without --resume to start again", damage));
  if (restored_) return Beginning::must_start_again;
  return std::nullopt;
}

/// Collective. Whether the output is this run, finished, and all its checkpoints exist. Missing ones are added to
/// `lost`. Throws InputError if it is another finished run.
bool Continuation::found_complete(std::vector<std::string>& lost) const {
  const bool complete = root_finds(ranks_, [&] {
    if (rolling_checkpoint_exists(options_.output) || !fs::exists(options_.output)) return false;
    const RunSummary run = read_run_summary(options_.output);
    if (run.status != "complete") return false;
    refuse_other_run(run);
    lost = missing_checkpoints(promised_checkpoints(scenario_, options_.output, run.first_density, run.largest_density),
                               identity_from(run.from));
    return lost.empty();
  });
  if (complete) {
    root_does(ranks_, [this] { remove_unfinished(options_.output); }); // of a run killed while it tidied up
    report_.note(options_.output + " is already complete");
    return true;
  }
  lost = root_lists(ranks_, [&] { return lost; });
  return false;
}

/// Throws InputError unless the complete run in the output is that of this scenario, packing and beginning (if one is
/// named): with --resume it would be replaced unnoticed.
void Continuation::refuse_other_run(const RunSummary& run) const {
  const auto refuse = [this](const std::string& what) {
    throw InputError(
        fmt::format("{}: the complete run there {}, allowed: another --output, or no --resume to replace it",
                    one_line(options_.output), what));
  };
  if (run.packing_hash != identity_.packing_hash) refuse("has another packing");
  if (run.scenario_text != scenario_.text)
    refuse("has another scenario" + scenario_difference(run.scenario_text, scenario_.text));
  if (options_.from && !run.from.empty() && run.from != identity_.from)
    refuse("did not begin at " + one_line(*options_.from));
}

/// Collective. Restores the best checkpoint. False if there is none; `damage` then says what is wrong with the first
/// damaged one.
bool Continuation::restore_best(std::vector<std::string>& lost, std::string& damage) {
  for (const std::string& path : root_lists(ranks_, [this] { return resumable_checkpoints(scenario_, identity_); })) {
    if (const std::string found = damage_of(path, ranks_); !found.empty()) {
      report_.warning(found + "; looking for an earlier checkpoint");
      if (damage.empty()) damage = found;
      continue;
    }
    if (!restore(path, lost)) continue;
    if (path == name_of_previous_checkpoint(options_.output)) // whatever is in the rolling one's place is worse
      root_does(ranks_, [&] { fs::rename(path, name_of_checkpoint(options_.output)); });
    if (!lost.empty())
      report_.warning(fmt::format("{} is missing; the run continues from {} to write it", lost.front(), path));
    if (!options_.redistributed) report_.note(fmt::format("resumed {} at step {}", path, simulation_.state().step));
    return true;
  }
  return false;
}

/// Collective. Restores a checkpoint. False if the run cannot continue from it. Missing checkpoints that it counts as
/// written are added to `lost`.
bool Continuation::restore(const std::string& path, std::vector<std::string>& lost) {
  restored_ = true;
  record_ = {};
  mpfem::resume(path, simulation_, record_, ranks_);
  if (options_.from && !record_.from.empty() && record_.from != identity_.from)
    throw InputError(
        fmt::format("{}: the checkpoint belongs to a run that did not begin at {}; run without --resume to start again",
                    path, one_line(*options_.from)));
  const auto missing = root_lists(ranks_, [this] { return missing_written_checkpoints(); });
  lost.insert(lost.end(), missing.begin(), missing.end());
  if (!missing.empty()) return false;
  const auto snapshots =
      root_lists(ranks_, [this] { return missing_snapshots(options_.output, record_.snapshot_files); });
  if (snapshots.empty()) return true;
  // The checkpoints that a complete run keeps count on snapshots that it has removed; the rolling one does not.
  const bool rolling = path == name_of_checkpoint(options_.output);
  if (!rolling || !lost.empty()) return false;
  throw InputError(
      fmt::format("{}: the snapshot {}, taken before this checkpoint, is missing; run without --resume to start again",
                  path, snapshots.front()));
}

/// Checkpoints of stages and densities that must have been written by now and are not on disk.
std::vector<std::string> Continuation::missing_written_checkpoints() const {
  const double start =
      record_.history.empty() ? simulation_.relative_density() : record_.history.front().relative_density;
  return missing_checkpoints(promised_checkpoints(scenario_, options_.output, simulation_.state().stage,
                                                  simulation_.stage_complete(), record_.checkpoints_passed, start),
                             identity_from(record_.from));
}

/// This run, if it began there.
RunIdentity Continuation::identity_from(const std::string& from) const {
  RunIdentity identity = identity_;
  identity.from = from;
  return identity;
}

void Continuation::discard_unfinished_run() const {
  const std::string rolling = name_of_checkpoint(options_.output);
  if (fs::exists(rolling))
    report_.note(fmt::format("discarding {} of an unfinished run, because this run starts again (--resume would have "
                             "continued it)",
                             rolling));
  remove_unfinished(options_.output);
}

void Continuation::check_written_checkpoints() const {
  if (const auto missing = missing_written_checkpoints(); !missing.empty())
    throw StorageError(fmt::format("{}: the run has written this file, but it is gone; --resume writes it again",
                                   one_line(missing.front())));
}

std::vector<std::string> Continuation::resumable() const {
  return resumable_checkpoints(scenario_, identity_from(record_.from));
}

} // namespace mpfem
