#include "solver/run/check_output.hpp"

#include <filesystem>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "solver/run/checkpoints.hpp"

namespace mpfem {

namespace {

bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return std::filesystem::equivalent(a, b, ignored) ||
         std::filesystem::weakly_canonical(a, ignored) == std::filesystem::weakly_canonical(b, ignored);
}

/// Refuses to begin at a checkpoint (`from`) whose name is that of one of the run's own checkpoints.
void check_from(const std::string& from, const Scenario& scenario, const std::string& output) {
  std::vector<std::string> written{checkpoint_path(output), previous_checkpoint_path(output)};
  for (const Stage& stage : scenario.stages) written.push_back(stage_checkpoint_path(output, stage.name));
  for (const double density : scenario.output.checkpoint_relative_densities)
    written.push_back(density_checkpoint_path(output, density));
  for (const std::string& path : written)
    if (same_file(path, from))
      throw InputError(fmt::format(
          "--from {}: this run would write its own checkpoint there; allowed: another --output", one_line(from)));
}

/// Writes a partial file under the name that the run file's will have, and removes it.
void try_to_write(const std::string& output) {
  const std::string trial = output_target(output) + ".partial";
  remove_stale_partial(trial);
  if (!std::ofstream(trial)) throw StorageError(fmt::format("{}: cannot be written", one_line(trial)));
  std::error_code ignored;
  std::filesystem::remove(trial, ignored);
}

} // namespace

void check_output(const Scenario& scenario, const RunOptions& options) {
  const std::string& output = options.output;
  check_output_path("--output", output, OutputKind::binary);
  const auto refuse = [&](const std::string& file, const std::string& what) {
    if (same_file(output, file))
      throw InputError(
          fmt::format("--output {}: would overwrite {} of this run; choose another name", one_line(output), what));
  };
  refuse(scenario.packing_file, "the packing");
  refuse(options.scenario_file, "the scenario");
  if (options.from) {
    refuse(*options.from, "the checkpoint to start from");
    check_from(*options.from, scenario, output);
  }
  try_to_write(output);
}

} // namespace mpfem
