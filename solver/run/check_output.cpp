#include "solver/run/check_output.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "common/run_stem.hpp"
#include "common/table_reader.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/scenario/read_scenario.hpp"

namespace mpfem {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> inputs_of(const Scenario& scenario, const RunOptions& options) {
  std::vector<std::string> inputs{options.scenario_file, scenario.packing_file};
  for (const ToolParameters& tool : scenario.tools)
    if (const auto* stl = std::get_if<StlShape>(&tool.shape)) inputs.push_back(stl->file);
  if (options.from) inputs.push_back(*options.from);
  return inputs;
}

/// `text` without `ending`; none if it does not end so.
std::optional<std::string> without(const std::string& text, std::string_view ending) {
  if (!text.ends_with(ending)) return std::nullopt;
  return text.substr(0, text.size() - ending.size());
}

/// Paths of the checkpoints that the run in this rolling checkpoint keeps, as those of `run_file`. None if it cannot be
/// read.
std::vector<std::string> kept_by_run_in(const std::string& rolling, const std::string& run_file) {
  try {
    const std::string text = CheckpointReader(rolling).scenario_text();
    return kept_checkpoints(read_scenario(TomlDocument::from_text(text, rolling)), run_file);
  } catch (const InputError&) {
    return {};
  }
}

/// Refuses to write over checkpoints of other runs. The checkpoint of RUN.h5 at the end of its stage `press` is called
/// as the rolling checkpoint of RUN.press.h5, and the files of a run without an ending as those of RUN.h5.
void refuse_checkpoints_of_other_runs(const Scenario& scenario, const std::string& output) {
  const auto refuse = [&](const std::string& checkpoint, const std::string& run) {
    throw InputError(fmt::format("--output {}: {} would be replaced, which belongs to the run {}, allowed: another "
                                 "--output",
                                 one_line(output), one_line(checkpoint), one_line(run)));
  };
  const std::string rolling = name_of_checkpoint(output), stem = run_stem(output);
  for (const std::string& ending : kept_by_run_in(rolling, ""))
    if (const auto other = without(rolling, ending))
      if (const std::string run = *other + ".h5"; fs::exists(run) || fs::exists(name_of_checkpoint(run)))
        refuse(rolling, run);
  for (const std::string& kept : kept_checkpoints(scenario, output))
    if (const std::string run = *without(kept, ".checkpoint.h5") + ".h5"; fs::exists(kept) && fs::exists(run))
      refuse(kept, run);
  if (const std::string run = stem == output ? output + ".h5" : stem; fs::is_regular_file(run)) refuse(rolling, run);
}

/// Refuses to write a checkpoint over something else than a checkpoint.
void refuse_no_checkpoints(const Scenario& scenario, const std::string& output) {
  for (const std::string& checkpoint : all_checkpoints(scenario, output)) {
    if (holds_something_else(checkpoint))
      throw InputError(fmt::format("--output {}: its checkpoint would replace {}, which is no checkpoint, allowed: "
                                   "another --output",
                                   one_line(output), one_line(checkpoint)));
  }
}

/// True for a file that does not begin as one of HDF5, nor with the zeros of one whose beginning is not written yet.
bool begins_as_something_else(const std::string& path) {
  if (is_hdf5(path)) return false;
  std::array<char, 8> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return begin != std::array<char, 8>{};
}

/// Refuses outputs beside which the run would remove a file of the user as the rest of an interrupted write.
void refuse_no_partial_files(const Scenario& scenario, const std::string& output) {
  for (const std::string& path : partial_files(scenario, output))
    if (fs::is_regular_file(path) && begins_as_something_else(path))
      throw InputError(fmt::format("--output {}: {} would be removed, which is no part of a run, allowed: another "
                                   "--output",
                                   one_line(output), one_line(path)));
}

/// Refuses names that mpfem gives to files beside another run.
void refuse_endings_of_files_beside_runs(const std::string& output) {
  for (const std::string_view ending : {".lock", ".partial", "~"})
    if (output.ends_with(ending))
      throw InputError(fmt::format("--output {}: found the ending {}, which files beside a run have, allowed: another, "
                                   "as .h5",
                                   one_line(output), ending));
}

} // namespace

void check_output(const Scenario& scenario, const RunOptions& options) {
  const std::string& output = options.output;
  check_output_path("--output", output, OutputKind::binary);
  refuse_endings_of_files_beside_runs(output);
  for (const std::string& input : inputs_of(scenario, options)) {
    refuse_overwriting("--output", output, input);
    for (const std::string& checkpoint : all_checkpoints(scenario, output))
      refuse_overwriting(fmt::format("--output {}: its checkpoint", one_line(output)), checkpoint, input);
  }
  refuse_checkpoints_of_other_runs(scenario, output);
  refuse_no_checkpoints(scenario, output);
  refuse_no_partial_files(scenario, output);
  try_output(output);
}

} // namespace mpfem
