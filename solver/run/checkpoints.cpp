#include "solver/run/checkpoints.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/run_stem.hpp"
#include "solver/parallel/root.hpp"

namespace mpfem {

namespace {

namespace fs = std::filesystem;

/// Where a new rolling checkpoint is written before it is known to be good.
std::string next_checkpoint_path(const std::string& run_file) {
  return run_stem(run_file) + ".checkpoint.next.h5";
}

/// Rounding does not decide whether a density is reached.
constexpr double nearly = 1 - 1e-9;

std::vector<std::string> of_stages(const Scenario& scenario, const std::string& run_file, std::size_t count) {
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < std::min(count, scenario.stages.size()); ++i)
    paths.push_back(name_of_kept_checkpoint(run_file, scenario.stages[i].name));
  return paths;
}

/// As of snapshot_name(), or a part of such a file.
bool is_snapshot_name(std::string_view name) {
  constexpr std::string_view begin = "snapshot-", partial = ".partial", ending = ".h5";
  if (!name.starts_with(begin)) return false;
  name.remove_prefix(begin.size());
  if (name.ends_with(partial)) name.remove_suffix(partial.size());
  if (!name.ends_with(ending)) return false;
  name.remove_suffix(ending.size());
  return !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Removes the run's own files from its folder of snapshots.
template <class Wanted>
void remove_snapshots(const std::string& run_file, const Wanted& wanted) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(parts_folder(run_file), ignored))
    if (const std::string name = entry.path().filename().string(); is_snapshot_name(name) && wanted(name))
      found.push_back(entry.path());
  for (const fs::path& path : found) fs::remove(path, ignored);
}

/// Throws StorageError if a checkpoint cannot be read back, and removes it.
void verify_written(const std::string& path, const std::string& rolling) {
  try {
    verify_checkpoint(path);
  } catch (const InputError& error) {
    std::error_code ignored;
    fs::remove(path, ignored);
    throw StorageError(
        fmt::format("{}: the checkpoint cannot be read back after writing ({}); the previous checkpoint is kept",
                    one_line(rolling), error.what()));
  }
}

} // namespace

std::string density_checkpoint_path(const std::string& run_file, double relative_density) {
  return name_of_kept_checkpoint(run_file, fmt::format("D{:.3f}", relative_density));
}

std::vector<std::string> kept_checkpoints(const Scenario& scenario, const std::string& run_file) {
  std::vector<std::string> paths = of_stages(scenario, run_file, scenario.stages.size());
  for (const double density : scenario.output.checkpoint_relative_densities)
    paths.push_back(density_checkpoint_path(run_file, density));
  return paths;
}

std::vector<std::string> all_checkpoints(const Scenario& scenario, const std::string& run_file) {
  std::vector<std::string> paths = kept_checkpoints(scenario, run_file);
  paths.insert(paths.end(), {name_of_checkpoint(run_file), name_of_previous_checkpoint(run_file)});
  return paths;
}

double size_on_disk(const Scenario& scenario, const std::string& run_file) {
  std::vector<fs::path> files{run_file};
  for (const std::string& path : all_checkpoints(scenario, run_file)) files.emplace_back(path);
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(parts_folder(run_file), failed)) files.push_back(entry.path());
  double bytes = 0;
  for (const fs::path& file : files)
    if (const auto size = fs::file_size(file, failed); !failed) bytes += static_cast<double>(size);
  return bytes;
}

std::string parts_folder(const std::string& run_file) {
  return run_stem(run_file) + ".parts";
}

std::string snapshot_name(std::size_t number) {
  return fmt::format("snapshot-{:04}.h5", number);
}

std::string snapshot_path(const std::string& run_file, const std::string& name) {
  return parts_folder(run_file) + "/" + name;
}

bool is_checkpoint_of(const std::string& path, const RunIdentity& run) {
  if (!fs::exists(path)) return false;
  try {
    const CheckpointReader file(path);
    return file.scenario_text() == run.scenario_text && file.packing_hash() == run.packing_hash &&
           (run.from.empty() || run.from == file.from());
  } catch (const InputError&) {
    return false;
  }
}

void replace_rolling_checkpoint(const Communicator& ranks, const std::string& run_file,
                                const std::function<void(const std::string&)>& write) {
  const std::string rolling = name_of_checkpoint(run_file), previous = name_of_previous_checkpoint(run_file),
                    next = next_checkpoint_path(run_file);
  root_does(ranks, [&] {
    std::error_code ignored;
    fs::remove(previous, ignored); // at most two are on disk; the one that stays was read back
  });
  write(next);
  root_does(ranks, [&] {
    verify_written(next, rolling);
    if (fs::exists(rolling)) fs::rename(rolling, previous);
    fs::rename(next, rolling);
  });
}

std::vector<std::string> promised_checkpoints(const Scenario& scenario, const std::string& run_file, std::int64_t stage,
                                              bool stage_complete, std::int64_t densities_passed,
                                              double start_density) {
  auto paths =
      of_stages(scenario, run_file, static_cast<std::size_t>(stage) + static_cast<std::size_t>(stage_complete));
  const auto& densities = scenario.output.checkpoint_relative_densities;
  for (std::size_t i = 0; i < std::min(densities.size(), static_cast<std::size_t>(densities_passed)); ++i)
    if (start_density < densities[i] * nearly) paths.push_back(density_checkpoint_path(run_file, densities[i]));
  return paths;
}

std::vector<std::string> promised_checkpoints(const Scenario& scenario, const std::string& run_file,
                                              double start_density, double largest_density) {
  auto paths = of_stages(scenario, run_file, scenario.stages.size());
  for (const double density : scenario.output.checkpoint_relative_densities)
    if (start_density < density * nearly && largest_density >= density * nearly)
      paths.push_back(density_checkpoint_path(run_file, density));
  return paths;
}

std::vector<std::string> missing_checkpoints(const std::vector<std::string>& promised, const RunIdentity& run) {
  std::vector<std::string> missing;
  std::copy_if(promised.begin(), promised.end(), std::back_inserter(missing),
               [&](const std::string& path) { return !is_checkpoint_of(path, run); });
  return missing;
}

std::vector<std::string> resumable_checkpoints(const Scenario& scenario, const RunIdentity& run) {
  std::vector<std::string> paths;
  if (const std::string rolling = name_of_checkpoint(run.run_file); fs::exists(rolling)) paths.push_back(rolling);
  // If no beginning is named, the rolling checkpoints show where the run began.
  RunIdentity unnamed = run;
  if (unnamed.from == "packing") unnamed.from.clear();
  if (const std::string previous = name_of_previous_checkpoint(run.run_file); is_checkpoint_of(previous, unnamed))
    paths.push_back(previous);

  std::vector<std::pair<std::int64_t, std::string>> kept; // by step
  for (const std::string& path : kept_checkpoints(scenario, run.run_file)) {
    if (is_checkpoint_of(path, run)) kept.emplace_back(CheckpointReader(path).step(), path);
  }
  std::sort(kept.rbegin(), kept.rend());
  for (const auto& [step, path] : kept) paths.push_back(path);
  return paths;
}

std::vector<std::string> partial_files(const Scenario& scenario, const std::string& run_file) {
  const std::string next = next_checkpoint_path(run_file);
  std::vector<std::string> files = kept_checkpoints(scenario, run_file);
  files.insert(files.end(), {run_file, name_of_checkpoint(run_file), next});
  for (std::string& path : files) path += ".partial";
  files.push_back(next); // not known to be good
  return files;
}

void remove_partial_files(const Scenario& scenario, const std::string& run_file) {
  std::error_code ignored;
  for (const std::string& path : partial_files(scenario, run_file)) fs::remove(path, ignored);
  remove_snapshots(run_file, [](const std::string& name) { return name.ends_with(".partial"); });
}

void remove_unfinished(const std::string& run_file) {
  // In this order: the previous checkpoint, the rolling one, and then the snapshots that it names.
  std::error_code ignored;
  fs::remove(name_of_previous_checkpoint(run_file), ignored);
  fs::remove(name_of_checkpoint(run_file), ignored);
  remove_snapshots(run_file, [](const std::string&) { return true; });
  fs::remove(parts_folder(run_file), ignored); // unless something else is in it
}

} // namespace mpfem
