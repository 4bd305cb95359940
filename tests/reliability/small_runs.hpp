#pragma once
// Small runs of eight grains through the executable.

#include <string>
#include <vector>

#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/packing_file.hpp"

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

/// Writes packing.h5 and scenario.toml. `cells`: along a grain's diameter.
inline void prepare_stages(const Folder& folder, const std::string& scenario, int cells = 3) {
  write_packing(folder / "packing.h5", eight_grains(cells), std::vector<double>(8, 0.1));
  write_text(folder / "scenario.toml", scenario);
}

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

/// Numbers that tell whether two runs are bitwise the same.
inline std::vector<double> numbers_of_run(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::run);
  std::vector<double> all;
  const auto take = [&](const auto& dataset, const std::string& snapshot) {
    for (const auto value : file.read(dataset, snapshot)) all.push_back(static_cast<double>(value));
  };
  namespace run = schema::run;
  for (const auto& column : {run::history_time, run::history_mean_stress, run::history_energy_residual,
                             run::history_kinetic_energy, run::history_contact_area})
    take(column, "");
  for (const std::string& name : file.snapshots()) {
    take(run::snapshots_node, name);
    take(run::snapshots_velocity, name);
    take(run::snapshots_von_mises, name);
  }
  return all;
}

} // namespace mpfem::test
