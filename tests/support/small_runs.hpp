#pragma once
// Short runs of eight grains through the executable: their scenarios, how they are run, and whether two of them are the
// same.

#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/same_files.hpp"

namespace mpfem::test {

/// Runs `mpfem` with these arguments.
inline Outcome mpfem_command(const std::string& arguments) {
  return run_command(fmt::format("'{}' {}", MPFEM_EXECUTABLE, arguments));
}

/// Isotropic compaction of eight grains to a relative density of 0.62.
inline const std::string scenario_text = material_text + R"([output]
history_rows = 20
snapshot_relative_densities = [0.52]
)" + compaction_text;

/// The same with bonds, unloaded and torn apart by grips.
inline const std::string bonded_text = scenario_text + R"(
[[stages]]
name = "unloading"
type = "isotropic_unloading"
mean_stress = 0
wall_speed = 20000
[[stages]]
name = "tearing"
type = "grip"
grip_depth = 0.03
displacement = 0.015
sliding = [0.01, 0, 0]
speed = 20000
[element]
type = "tet4-anp"
[bond]
tensile_strength = 25
shear_strength = 18
fracture_energy = 0.05
rebond = "on_contact"
)";

/// With bonds and every kind of loading: walls held by servos, taken away, and back.
inline const std::string loading_text = material_text + R"([bond]
tensile_strength = 25
shear_strength = 18
fracture_energy = 0.05
[output]
history_rows = 10
checkpoint_relative_densities = [0.5, 0.61]
[[stages]]
name = "compaction"
type = "isotropic_compaction"
mean_stress = 20
wall_speed = 20000
damping_rate = 1e6
damping_fade_stress = 5
[[stages]]
name = "cycles"
type = "stress_cycles"
lowest_mean_stress = 5
highest_mean_stress = 20
cycles = 1
wall_speed = 10000
quasi_static = { kinetic_tolerance = 0.02, stress_tolerance = 0.1 }
[[stages]]
name = "triaxial"
type = "triaxial_compression"
wall_speed = 5000
axial_strain = 0.02
[[stages]]
name = "probe"
type = "probe"
direction = [1, -1]
wall_speed = 3000
dissipation_ratio = 1.005
[[stages]]
name = "unconfined"
type = "unconfined_compression"
wall_speed = 10000
axial_strain = 0.03
stress_drop = 0.5
[[stages]]
name = "die"
type = "die_compression"
wall_speed = 10000
duration = 2e-6
[[stages]]
name = "held"
type = "hold"
mean_stress = 15
duration = 6e-6
)";

/// Packing and scenario of eight grains in a folder.
inline void prepare(const Folder& folder, int cells = 4, const std::string& text = scenario_text) {
  write_packing(folder / "packing.h5", eight_grains(cells), std::vector<double>(8, 0.1));
  write_text(folder / "scenario.toml", text);
}

/// `text` with the first `from` replaced; the test fails if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Every number of history and snapshots, in order.
inline std::vector<double> results(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::run);
  std::vector<double> all;
  const auto take = [&](const auto& dataset, const std::string& snapshot) {
    for (const auto value : file.read(dataset, snapshot)) all.push_back(static_cast<double>(value));
  };
  namespace run = schema::run;
  take(run::history_time, "");
  take(run::history_wall_stress, "");
  take(run::history_kinetic_energy, "");
  take(run::history_elastic_energy, "");
  take(run::history_plastic_dissipation, "");
  take(run::history_contact_energy, "");
  take(run::history_energy_residual, "");
  take(run::history_contact_area, "");
  take(run::history_bonds, "");
  take(run::history_damage_dissipation, "");
  if (file.has(run::history_friction_energy)) {
    take(run::history_friction_energy, "");
    take(run::history_friction_dissipation, "");
  }
  for (const std::string& name : file.snapshots()) {
    if (file.has(run::snapshots_wall_friction, name)) take(run::snapshots_wall_friction, name);
    take(run::snapshots_node, name);
    take(run::snapshots_velocity, name);
    take(run::snapshots_von_mises, name);
    take(run::snapshots_contact_pressure, name);
    take(run::snapshots_pair_force, name);
    if (!file.has(run::snapshots_bond_damage, name)) continue;
    take(run::snapshots_bond_damage, name);
    take(run::snapshots_bond_separation, name);
    take(run::snapshots_pair_damage_dissipation, name);
  }
  return all;
}

/// A run has bitwise the same results on 1, 2 and 4 threads.
inline void check_threads(const std::string& text, int cells) {
  const Folder folder;
  prepare(folder, cells, text);
  for (const int threads : {1, 2, 4}) {
    const std::string run = folder / fmt::format("run{}.h5", threads);
    const Outcome outcome =
        mpfem_command(fmt::format("run {} -o {} --threads {} --quiet", folder / "scenario.toml", run, threads));
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.only_warnings("mpfem")); // --quiet
    CHECK(first_difference(folder / "run1.h5", run).empty());
  }
}

/// Runs a command that writes `output`, stopping and resuming it at least twice. If the machine has become faster
/// since the whole run took `seconds`, it starts again with shorter parts.
inline void run_in_parts(const std::string& command, const std::string& output, double seconds) {
  int stops = 0;
  for (double limit = seconds / 5; stops < 2; limit /= 2) {
    REQUIRE(limit > seconds / 100);
    std::filesystem::remove(output);
    stops = 0;
    for (int code = 5; code == 5; stops += code == 5 ? 1 : 0) {
      const Outcome outcome = mpfem_command(fmt::format("{} --resume --time-limit {}", command, limit));
      code = outcome.exit_code;
      INFO(outcome.messages);
      REQUIRE((code == 0 || code == 5));
      CHECK(schema::validate(output).empty()); // readable at every stop
      REQUIRE(stops < 200);
    }
  }
}

/// A run that is stopped and resumed has bitwise the same results as one without stops.
inline void check_resuming(const std::string& text, int cells) {
  const Folder folder;
  prepare(folder, cells, text);
  const std::string common = fmt::format("run {} --threads 2 --quiet -o ", folder / "scenario.toml");
  const Outcome whole = mpfem_command(common + (folder / "whole.h5"));
  REQUIRE(whole.exit_code == 0);
  run_in_parts(common + (folder / "parts.h5"), folder / "parts.h5", whole.seconds);
  CHECK(first_difference(folder / "whole.h5", folder / "parts.h5").empty());
  const schema::FileReader in_one(folder / "whole.h5"), in_parts(folder / "parts.h5");
  for (const auto& dataset : {schema::run::provenance_stage_overshoot, schema::run::provenance_stage_hold_error,
                              schema::run::provenance_stage_hold_rms})
    CHECK(in_one.read(dataset) == in_parts.read(dataset));
  CHECK_FALSE(std::filesystem::exists(folder / "parts.checkpoint.h5"));
  CHECK(std::filesystem::exists(folder / "parts.compaction.checkpoint.h5"));
}

/// A scenario that is bitwise the same on any number of threads and when it is resumed, and whose plan says `what` it
/// has.
inline void check_variant(const std::string& text, const std::string& what) {
  check_threads(text, 4);
  check_resuming(text, 4);
  const Folder folder;
  prepare(folder, 3, text);
  CHECK_THAT(mpfem_command(fmt::format("check {}", folder / "scenario.toml")).output, Catch::Contains(what));
}

/// The scenario with smooth contact surfaces.
inline std::string with_smooth_surface(const std::string& text) {
  return replaced(text, "[output]", "[contact]\nsurface = \"smooth\"\n[output]");
}

} // namespace mpfem::test
