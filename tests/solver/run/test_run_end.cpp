// How runs end, what they say of it, and what is kept when they fail.

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "solver/output/run_lock.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/small_runs.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;
namespace fs = std::filesystem;

TEST_CASE("spheres that a packing file holds with meshes of their volume touch by their smooth surfaces, and the run "
          "says so") {
  const Folder folder;
  const MeshedPacking packing = eight_grains(4);
  const double volume = build_model(packing, holding_scenario(1), "test").reference_volume[0];
  for (const double factor : {1.0, 0.99}) {
    write_packing(folder / "packing.h5", packing, std::vector<double>(8, factor * std::cbrt(volume * 3 / (4 * M_PI))));
    write_text(folder / "scenario.toml", scenario_text);
    const std::string run = folder / fmt::format("run-{}.h5", factor);
    CHECK_THAT(mpfem_command(fmt::format("check {}", folder / "scenario.toml")).output,
               Catch::Contains(factor == 1 ? "by the grains' smooth surfaces" : "by the facets of the grains' meshes"));
    REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", run)).exit_code == 0);
    const schema::FileReader file(run, schema::FileKind::run);
    CHECK(file.read_scalar(schema::run::provenance_smooth_grains) == (factor == 1 ? 8 : 0));
  }
  // The same scenario text, another contact: cannot be continued.
  const Outcome other =
      mpfem_command(fmt::format("run {} -o {} --from {} --quiet --set contact.surface=smooth", folder / "scenario.toml",
                                folder / "other.h5", folder / "run-0.99.compaction.checkpoint.h5"));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.messages, Catch::Contains("0 of 8 grains") && Catch::Contains("contact.surface"));
}

TEST_CASE("a stage takes as many snapshots as wanted, each with a row of the history, also when it is resumed") {
  const Folder folder;
  prepare(folder, 3, scenario_text);
  const std::string run = folder / "run.h5";
  const std::string command = fmt::format("run {} -o {} --quiet --threads 1 --set stages.0.snapshots=4 "
                                          "--set output.snapshot_relative_densities=[]",
                                          folder / "scenario.toml", run);
  REQUIRE(mpfem_command(command + " --time-limit 0.001").exit_code == 5);
  REQUIRE(mpfem_command(command + " --resume").exit_code == 0);
  const schema::FileReader file(run, schema::FileKind::run);
  const auto times = file.read(schema::run::history_time);
  std::vector<double> taken;
  for (const std::string& name : file.snapshots()) taken.push_back(file.read_scalar(schema::run::snapshots_time, name));
  REQUIRE(times.size() == 21); // the first and twenty more
  CHECK(taken == std::vector<double>{times[5], times[10], times[15], times[20]});
}

TEST_CASE("a run says what ended its stages, and how well stresses were held") {
  const Folder folder;
  prepare(folder, 3, loading_text);
  const Outcome plan = mpfem_command(fmt::format("check {}", folder / "scenario.toml"));
  CHECK(plan.exit_code == 0);
  CHECK_THAT(plan.output, Catch::Contains("held at constant force") && Catch::Contains("x and y walls withdrawn") &&
                              Catch::Contains("all walls held at 15 MPa"));
  const Outcome outcome = mpfem_command(fmt::format("run {} -o {}", folder / "scenario.toml", folder / "run.h5"));
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.messages, Catch::Contains("stage 'triaxial' ended by axial strain 0.02; stresses held within"));
  CHECK_THAT(outcome.messages,
             Catch::Contains("stage 'cycles' ended by 1 cycle") && Catch::Contains("wall speed chosen between"));
  CHECK(schema::validate(folder / "run.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const auto name = file.read(schema::run::provenance_stage_name), end = file.read(schema::run::provenance_stage_end);
  REQUIRE(name == std::vector<std::string>{"compaction", "cycles", "triaxial", "probe", "unconfined", "die", "held"});
  CHECK(end[0] == "mean stress 20 MPa");
  CHECK_THAT(end[1], Catch::StartsWith("1 cycle; wall speed chosen between"));
  CHECK(end[5] == "duration 2e-06 s");
  CHECK(end[6] == "duration 6e-06 s");
  CHECK(file.read(schema::run::provenance_stage_hold_error)[6] > 0);
  CHECK(file.read(schema::run::provenance_stage_hold_error)[2] > 0);
  CHECK(file.read(schema::run::provenance_stage_hold_error)[5] == 0);
  const auto rms = file.read(schema::run::provenance_stage_hold_rms);
  CHECK(rms[2] > 0);
  CHECK(rms[3] > 0);
  CHECK(rms[5] == 0);
  CHECK_THAT(outcome.messages, Catch::Contains(fmt::format("{:.3g} MPa root mean square", rms[2])));
  CHECK(file.read(schema::run::provenance_stage_overshoot)[0] > 0);
}

TEST_CASE("one process at a time works on a run, and the lock of a killed one stops no other") {
  const Folder folder;
  prepare(folder, 3);
  const std::string command = fmt::format("run {} -o {} --quiet --resume", folder / "scenario.toml", folder / "run.h5");
  {
    const RunLock lock(folder / "run.h5");
    const Outcome second = mpfem_command(command);
    CHECK(second.exit_code == 2);
    CHECK(second.one_error_line("mpfem"));
    CHECK_THAT(second.messages, Catch::Contains("another mpfem is writing") && Catch::Contains("run.lock"));
    CHECK_FALSE(fs::exists(folder / "run.h5"));
    CHECK(mpfem_command(replaced(command, "run.h5", "other.h5")).exit_code == 0);
    fs::create_symlink(folder / "run.h5", folder / "link.h5");
    CHECK(mpfem_command(replaced(command, "run.h5", "link.h5")).exit_code == 2);
  }
  CHECK_FALSE(fs::exists(folder / "run.lock"));
  write_text(folder / "run.lock", "");
  CHECK(mpfem_command(command).exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "run.lock"));
}

TEST_CASE("files of the user beside a run are neither removed nor replaced") {
  const Folder folder;
  prepare(folder, 3);
  const auto run = [&](const std::string& output) {
    return mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / output));
  };
  for (const std::string name : {"run.lock", "run.h5.partial", "run.compaction.checkpoint.h5.partial"}) {
    INFO(name);
    write_text(folder / name, "notes");
    const Outcome outcome = run("run.h5");
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("mpfem"));
    CHECK_THAT(outcome.messages, Catch::Contains(name) && Catch::Contains("allowed: another --output"));
    CHECK(fs::file_size(folder / name) == 5);
    CHECK_FALSE(fs::exists(folder / "run.h5"));
    fs::remove(folder / name);
  }
  for (const std::string name : {"run.lock", "run.h5.partial", "run.h5~"}) {
    CHECK(run(name).exit_code == 2);
    CHECK_FALSE(fs::exists(folder / name));
  }
  // Zeros are a write that was killed before the beginning of its file was on disk.
  write_text(folder / "run.h5.partial", std::string(100, '\0'));
  fs::create_directory(folder / "run.parts");
  write_text(folder / "run.parts/snapshot-mine.h5", "notes");
  CHECK(run("run.h5").exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "run.h5.partial"));
  CHECK(fs::exists(folder / "run.parts/snapshot-mine.h5"));
}

TEST_CASE("a failure at the step of a checkpoint says that the checkpoint is of the failed step") {
  const Folder folder;
  prepare(folder, 3);
  // An unstable step, and a checkpoint after each.
  const Outcome outcome =
      mpfem_command(fmt::format("run {} -o {} --quiet --set element.type=tet4 --set numerics.time_step_factor=2 --set "
                                "output.checkpoint_interval=1e-6",
                                folder / "scenario.toml", folder / "run.h5"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.messages, Catch::Contains("the last checkpoint before the failure is ") &&
                                   Catch::Contains("run.checkpoint.previous.h5 (") &&
                                   Catch::Contains("run.checkpoint.h5 is of the failed step)"));
}

TEST_CASE("a stage of a few steps is not judged by the energies of its start") {
  const Folder folder;
  // Grips pull an elastic grain by a small part of its size at full speed.
  prepare(folder, 3, R"(packing = "packing.h5"
[material]
density = 1.55e-9
youngs_modulus = 5000
poissons_ratio = 0.3
[material.hardening]
law = "elastic"
[[stages]]
type = "grip"
grip_depth = 0.05
displacement = 1e-3
speed = 10000
)");
  const Outcome outcome =
      mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("a strain that is shorter than a step's way is reached") {
  const Folder folder;
  prepare(folder, 2, scenario_text.substr(0, scenario_text.find("[[stages]]")) + R"([[stages]]
type = "die_compression"
wall_speed = 1e5
axial_strain = 1e-6
)");
  const std::string run = folder / "run.h5";
  const Outcome outcome = mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", run));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  const auto strain = schema::FileReader(run, schema::FileKind::run).read(schema::run::history_axial_strain);
  CHECK(within(strain.back(), 1e-6, 2e-3)); // walls have arrived when they are within a strain of 1e-9
}

TEST_CASE("a loading that cannot reach its end exits with 3 and keeps what was computed") {
  const Folder folder;
  prepare(folder, 3, scenario_text + R"(
[[stages]]
type = "probe"
direction = [-1, 0]
wall_speed = 10000
dissipation_ratio = 2
)");
  const Outcome outcome =
      mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.messages, Catch::Contains("probe-2") && Catch::Contains("pull"));
  CHECK(schema::validate(folder / "run.h5").empty());
}

TEST_CASE("a run says what mass scaling does and what damping takes") {
  const Folder folder;
  prepare(folder, 3);
  const Outcome outcome = mpfem_command(
      fmt::format("run {} -o {} --set numerics.mass_scaling=4", folder / "scenario.toml", folder / "run.h5"));
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.messages, Catch::Contains("all masses multiplied by 4: steps are 2 times as long") &&
                                   Catch::Contains("ended by relative density 0.62; damping ") &&
                                   Catch::Contains("% of the elastic energy"));
}

TEST_CASE("a step too large for the motion to be stable exits with 3, says so, and keeps what was computed") {
  const Folder folder;
  prepare(folder, 4);
  const auto run = [&](double factor) {
    return mpfem_command(fmt::format("run {} -o {} --quiet --set element.type=tet4 --set numerics.time_step_factor={}",
                                     folder / "scenario.toml", folder / "run.h5", factor));
  };
  CHECK(run(1.0).exit_code == 0);
  const Outcome outcome = run(2.0);
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.messages, Catch::Contains("energy balance") && Catch::Contains("time_step_factor"));
  CHECK(schema::validate(folder / "run.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.read(schema::run::history_time).size() > 1);
  CHECK(run(2.1).exit_code == 2);
}
