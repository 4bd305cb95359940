// Stages that cannot reach their ends, runs that would never end, and numbers that are none.

#include <filesystem>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/run_quality.hpp"
#include "solver/run/history_schedule.hpp"
#include "tests/reliability/small_runs.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace fs = std::filesystem;

namespace {

const std::string pressed = material_text + R"([output]
history_rows = 10
[[stages]]
name = "pressed"
type = "isotropic_compaction"
relative_density = 0.6
wall_speed = 20000
damping_rate = 1e6
damping_fade_stress = 5
)";

std::string stage(const std::string& keys) {
  return "[[stages]]\nname = \"wrong\"\n" + keys;
}

/// The run up to a stage, and with a stage on top that cannot end.
Outcome run_with(const Folder& folder, const std::string& keys) {
  prepare(folder, 3, pressed + stage(keys));
  return run_stages(folder, "run.h5");
}

} // namespace

TEST_CASE("a stage whose target lies behind it ends the run with code 3, names stage, value and target") {
  const Folder folder;
  for (const auto& [keys, key] : std::vector<std::pair<std::string, std::string>>{
           {"type = \"isotropic_unloading\"\nmean_stress = 900\nwall_speed = 10000\n", "mean_stress"},
           {"type = \"isotropic_compaction\"\nmean_stress = 0.01\nwall_speed = 10000\n", "mean_stress"},
           {"type = \"isotropic_compaction\"\nrelative_density = 0.599\nwall_speed = 10000\n", "relative_density"},
           {"type = \"die_compression\"\naxial_strain = 0.1\naxial_stress = 0.01\nwall_speed = 10000\n",
            "axial_stress"},
           {"type = \"probe\"\ndirection = [1, 0]\nmean_stress = 0.01\nwall_speed = 10000\n", "mean_stress"}}) {
    const Outcome outcome = run_with(folder, keys);
    INFO(keys << outcome.messages);
    // What is known beforehand is refused before anything is written.
    const bool known = key == "relative_density";
    CHECK(outcome.exit_code == (known ? 2 : 3));
    CHECK(outcome.one_error_line("mpfem"));
    CHECK_THAT(outcome.messages, Catch::Contains("stage 'wrong'") && Catch::Contains(key));
    CHECK(fs::exists(folder / "run.h5") == !known);
    fs::remove(folder / "run.h5");
    fs::remove(folder / "run.checkpoint.h5");
  }
}

TEST_CASE("a branch whose first stage cannot be reached from its checkpoint is refused before its first step") {
  const Folder folder;
  prepare(folder, 3, pressed);
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  prepare(folder, 3,
          material_text + stage("type = \"isotropic_unloading\"\nmean_stress = 900\n"
                                "wall_speed = 10000\n"));
  const Outcome branch = run_stages(folder, "branch.h5", "--from " + (folder / "run.pressed.checkpoint.h5"));
  INFO(branch.messages);
  CHECK(branch.exit_code == 2);
  CHECK(branch.one_error_line("mpfem"));
  CHECK_FALSE(fs::exists(folder / "branch.h5"));
  const Outcome plain = run_stages(folder, "plain.h5"); // nothing acts yet
  CHECK(plain.exit_code == 2);
}

TEST_CASE("a hold that misses its stress by more than a tenth fails, says by how much and what helps") {
  const Folder folder;
  const Outcome missed = run_with(folder, "type = \"hold\"\nmean_stress = 60\nduration = 3e-7\nservo_speed = 10\n");
  INFO(missed.messages);
  CHECK(missed.exit_code == 3);
  CHECK_THAT(missed.messages, Catch::Contains("stage 'wrong'") && Catch::Contains("below the 60 MPa") &&
                                  Catch::Contains("longer duration") && Catch::Contains("servo_speed"));
}

TEST_CASE("a grip that would hold the whole packing is bad input") {
  const Folder folder;
  const Outcome outcome = run_with(folder, "type = \"grip\"\ngrip_depth = 5\ndisplacement = 0.01\nspeed = 10000\n");
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Catch::Contains("grip_depth"));
}

TEST_CASE("a scenario that would never end, or whose numbers overflow, is refused before it begins") {
  const Folder folder;
  prepare(folder, 3, pressed);
  for (const auto& [assignment, word] :
       std::vector<std::pair<std::string, std::string>>{{"stages.0.wall_speed=1e-12", "steps"},
                                                        {"material.youngs_modulus=1e308", "youngs_modulus"},
                                                        {"material.density=1e-300", "density"}}) {
    for (const std::string& command :
         {stages_command(folder, "run.h5"), fmt::format("'{}' check {}", MPFEM_EXECUTABLE, folder / "scenario.toml")}) {
      const Outcome outcome = run_command("timeout 20 " + command + " --set " + assignment);
      INFO(command << assignment << "\n" << outcome.messages);
      CHECK(outcome.exit_code == 2);
      CHECK_THAT(outcome.messages, Catch::Contains(word));
    }
    CHECK_FALSE(fs::exists(folder / "run.h5"));
  }
}

TEST_CASE("rows of a stage are even up to ten times its expected time, and bounded beyond") {
  for (const std::int64_t rows : {0, 1, 7, 100, 999}) CHECK(next_row_time(2.0, rows, 100) == 2.0 * double(rows) / 100);
  double before = 0;
  std::int64_t rows = 0;
  for (; next_row_time(2.0, rows, 100) < 100 * 2.0; ++rows) {
    CHECK(next_row_time(2.0, rows, 100) >= before);
    before = next_row_time(2.0, rows, 100);
  }
  CHECK(static_cast<double>(rows) <= most_rows(100));
}

TEST_CASE("snapshots of a stage are taken with evenly spaced rows, none with the first, and at most one for each row") {
  const auto rows_with_snapshot = [](int rows, int snapshots) {
    std::vector<std::int64_t> taken;
    for (std::int64_t row = 0; row <= rows; ++row)
      if (snapshot_due(row, row + 1, rows, snapshots)) taken.push_back(row);
    return taken;
  };
  CHECK(rows_with_snapshot(20, 0).empty());
  CHECK(rows_with_snapshot(20, 4) == std::vector<std::int64_t>{5, 10, 15, 20});
  CHECK(rows_with_snapshot(10, 3) == std::vector<std::int64_t>{4, 7, 10}); // not before a third of the time
  CHECK(rows_with_snapshot(3, 100) == std::vector<std::int64_t>{1, 2, 3});
  CHECK_FALSE(snapshot_due(5, 5, 20, 4)); // no row in this step
  CHECK(snapshot_due(4, 8, 20, 4));       // a row that stands for several
}

TEST_CASE("motion that is not finite stops every kind of stage, and the message names grain, place, cause and last "
          "checkpoint") {
  const Folder folder;
  const std::vector<std::string> stages = {
      "type = \"isotropic_compaction\"\nrelative_density = 0.7\nwall_speed = 20000\n",
      "type = \"isotropic_unloading\"\nmean_stress = 0\nwall_speed = 20000\n",
      "type = \"isotropic_compaction\"\nmean_stress = 500\nwall_speed = 20000\n",
      "type = \"stress_cycles\"\nlowest_mean_stress = 1\nhighest_mean_stress = 500\ncycles = 1\nwall_speed = 20000\n",
      "type = \"triaxial_compression\"\naxial_strain = 0.3\nwall_speed = 20000\n",
      "type = \"probe\"\ndirection = [1, 1]\nmean_stress = 900\nwall_speed = 20000\n",
      "type = \"unconfined_compression\"\naxial_strain = 0.3\nwall_speed = 20000\n",
      "type = \"die_compression\"\naxial_strain = 0.3\nwall_speed = 20000\n",
      "type = \"hold\"\nmean_stress = 30\nduration = 1e-6\n",
      "type = \"hold\"\nduration = 1e-6\n",
      "type = \"grip\"\ngrip_depth = 0.03\ndisplacement = 0.015\nspeed = 20000\n"};
  // Grains that fly apart hundreds of times as fast as sound, in a stage that begins at once.
  std::string velocities = "[initial]\ngrain_velocity = [[0, 0, 1e12]";
  for (int grain = 1; grain < 8; ++grain) velocities += ", [0, 0, 0]";
  for (const std::string& keys : stages) {
    prepare(folder, 3, material_text + velocities + "]\n" + stage(keys));
    const Outcome outcome = run_command("timeout 20 " + stages_command(folder, "run.h5"));
    INFO(keys << outcome.messages);
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.one_error_line("mpfem"));
    CHECK_THAT(outcome.messages,
               Catch::Contains("step ") && Catch::Contains("grain ") && Catch::Contains("checkpoint"));
    fs::remove(folder / "run.h5");
  }
}

TEST_CASE("a run that fails names the last checkpoint before the failure") {
  const Folder folder;
  const Outcome outcome = run_with(folder, "type = \"isotropic_unloading\"\nmean_stress = 900\nwall_speed = 10000\n");
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.messages,
             Catch::Contains("the last checkpoint before the failure is " + (folder / "run.checkpoint.h5")));
}

TEST_CASE("a run is doubtful where its energies, penetration, density or step say so, and only there") {
  const QualityRow good{.external_work = 1,
                        .energy_residual = 1e-3,
                        .kinetic_energy = 1e-3,
                        .internal_energy = 0.9,
                        .mean_stress = 10,
                        .penetration = 0.02,
                        .current_density = 0.9,
                        .time_step = 1e-9};
  CHECK(quality_warnings(std::vector{good, good}).empty());
  CHECK(quality_warnings({}).empty());
  const auto only = [&](const QualityRow& bad, const std::string& word) {
    const auto warnings = quality_warnings(std::vector{good, bad});
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings.front(), Catch::Contains(word));
  };
  QualityRow row = good;
  row.energy_residual = -0.02, only(row, "energy balance"), row = good;
  row.kinetic_energy = 0.2, only(row, "kinetic"), row = good;
  row.penetration = 0.3, only(row, "penetrate"), row = good;
  row.current_density = 1.01, only(row, "pores"), row = good;
  row.time_step = 1e-13, only(row, "time step"), row = good;
  row.kinetic_energy = 5, row.mean_stress = 0.5; // loose: ratios mean nothing
  CHECK(quality_warnings(std::vector{good, row}).empty());
}

TEST_CASE("a run whose standard streams are closed writes no message into its files") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "open.h5").exit_code == 0);
  std::string loud = stages_command(folder, "closed.h5");
  loud.erase(loud.find(" --quiet"), 8);
  CHECK(run_command("( " + loud + " ) <&- >&- 2>&-").exit_code == 0);
  CHECK(results(folder / "closed.h5") == results(folder / "open.h5"));
  CHECK(schema::validate(folder / "closed.h5").empty());
}
