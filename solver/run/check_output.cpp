#include "solver/run/check_output.hpp"

#include <filesystem>
#include <fstream>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "solver/run/checkpoints.hpp"

namespace mpfem {

namespace {

std::vector<std::string> inputs_of(const Scenario& scenario, const RunOptions& options) {
  std::vector<std::string> inputs{options.scenario_file, scenario.packing_file};
  for (const ToolParameters& tool : scenario.tools)
    if (const auto* stl = std::get_if<StlShape>(&tool.shape)) inputs.push_back(stl->file);
  if (options.from) inputs.push_back(*options.from);
  return inputs;
}

std::vector<std::string> checkpoints_of(const Scenario& scenario, const std::string& output) {
  std::vector<std::string> checkpoints{checkpoint_path(output), previous_checkpoint_path(output)};
  for (const Stage& stage : scenario.stages) checkpoints.push_back(stage_checkpoint_path(output, stage.name));
  for (const double density : scenario.output.checkpoint_relative_densities)
    checkpoints.push_back(density_checkpoint_path(output, density));
  return checkpoints;
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
  for (const std::string& input : inputs_of(scenario, options)) {
    refuse_overwriting("--output", output, input);
    for (const std::string& checkpoint : checkpoints_of(scenario, output))
      refuse_overwriting(fmt::format("--output {}: its checkpoint", one_line(output)), checkpoint, input);
  }
  try_to_write(output);
}

} // namespace mpfem
