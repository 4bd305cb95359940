#pragma once
// Small runs of two stages, also as a shell command.

#include <string>

#include <fmt/format.h>

#include "tests/support/small_runs.hpp"

namespace mpfem::test {

/// Two compactions, with a checkpoint at a density within the first.
inline const std::string two_stages = material_text + R"([output]
history_rows = 10
checkpoint_relative_densities = [0.5]
[[stages]]
name = "first"
type = "isotropic_compaction"
relative_density = 0.56
wall_speed = 40000
[[stages]]
name = "second"
type = "isotropic_compaction"
relative_density = 0.6
wall_speed = 40000
)";

inline std::string stages_command(const Folder& folder, const std::string& output) {
  return fmt::format("'{}' run {} -o {} --threads 1 --quiet", MPFEM_EXECUTABLE, folder / "scenario.toml",
                     folder / output);
}

inline Outcome run_stages(const Folder& folder, const std::string& output, const std::string& options = "") {
  std::string command = stages_command(folder, output);
  if (options.find("--resume") != std::string::npos)
    command.erase(command.find(" --quiet"), 8); // what it says is looked at
  return run_command(command + " " + options);
}

} // namespace mpfem::test
