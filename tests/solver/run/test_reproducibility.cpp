// Runs are bitwise the same on any number of threads, and when they are stopped, killed and resumed.

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/small_runs.hpp"

using namespace mpfem;
using namespace mpfem::test;
namespace fs = std::filesystem;

TEST_CASE("a run is bitwise the same on one, two and four threads") {
  check_threads(scenario_text, 4);
}

TEST_CASE("a run with bonds, unloading and grips is bitwise the same on one, two and four threads") {
  check_threads(bonded_text, 3);
  // There were bonds, and some broke.
  const Folder folder;
  prepare(folder, 3, bonded_text);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.read(schema::run::history_bonds).back() > 0);
  CHECK(file.read(schema::run::history_damage_dissipation).back() > 0);
}

TEST_CASE(
    "a run with smooth contact surfaces is bitwise the same on one, two and four threads, and when it is resumed") {
  check_variant(with_smooth_surface(bonded_text), "smooth surfaces");
}

TEST_CASE("a run in mixed precision is bitwise the same on one, two and four threads, and when it is resumed") {
  check_variant(replaced(bonded_text, "type = \"tet4-anp\"", "type = \"tet4-anp\"\nprecision = \"mixed\""),
                "tet4-anp, mixed precision");
}

TEST_CASE("a run through every loading is bitwise the same on one, two and four threads") {
  check_threads(loading_text, 3);
}

TEST_CASE("a run through every loading that is stopped and resumed ends bitwise as if it had not been") {
  check_resuming(loading_text, 4);
}

TEST_CASE("a run that is stopped and resumed again and again ends bitwise as if it had not been") {
  check_resuming(scenario_text, 6);
}

TEST_CASE("a run with bonds, unloading and grips that is stopped and resumed ends bitwise as if it had not been") {
  check_resuming(bonded_text, 4);
  check_resuming(replaced(bonded_text, "rebond = \"on_contact\"", "rebond = \"never\""), 4);
}

TEST_CASE("a killed run continues from its checkpoint and ends bitwise like a run that was not killed") {
  const Folder folder;
  prepare(folder, 6);
  const std::string common = fmt::format("run {} --threads 2 --quiet -o ", folder / "scenario.toml");
  const Outcome whole = mpfem_command(common + (folder / "whole.h5"));
  REQUIRE(whole.exit_code == 0);
  write_text(
      folder / "scenario.toml",
      replaced(scenario_text, "[output]\n", fmt::format("[output]\ncheckpoint_interval = {}\n", whole.seconds / 20)));
  int kills = 0;
  for (int code = -1; code != 0;) {
    const Outcome run = run_command(fmt::format("timeout -s KILL {} '{}' {} --resume", whole.seconds / 3,
                                                MPFEM_EXECUTABLE, common + (folder / "killed.h5")));
    code = run.exit_code;
    CAPTURE(code, run.messages);
    REQUIRE((code == 0 || code == 137));
    kills += code != 0;
    REQUIRE(kills < 100);
  }
  CHECK(kills >= 1);
  CHECK(results(folder / "whole.h5") == results(folder / "killed.h5"));
}

TEST_CASE("a run that is told to stop several times at once, or whose terminal is closed, saves its state and stops") {
  const std::string signal = GENERATE("TERM", "HUP");
  const Folder folder;
  prepare(folder, 6);
  // The first checkpoint, at a density just above the start's, says that the time loop has begun.
  const std::string command =
      fmt::format("'{}' run {} -o {} --threads 1 --quiet --set output.checkpoint_relative_densities=[0.44]",
                  MPFEM_EXECUTABLE, folder / "scenario.toml", folder / "run.h5");
  const Outcome outcome = run_command(fmt::format("{} & pid=$!; while [ ! -e {} ] && kill -0 $pid; do sleep 0.01; "
                                                  "done; for i in 1 2 3 4 5 6 7 8; do kill -{} $pid "
                                                  "2>/dev/null; sleep 0.002; done; wait $pid",
                                                  command, folder / "run.D0.440.checkpoint.h5", signal));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.messages, Catch::Contains("continue with --resume"));
  CHECK(schema::validate(folder / "run.checkpoint.h5").empty());
}

TEST_CASE("resuming a complete run leaves it as it is, and a fresh run does not mix with an unfinished one") {
  const Folder folder;
  prepare(folder);
  fs::create_directories(folder / "run.parts");
  write_text(folder / "run.parts/mine.txt", "a user's own file");
  const std::string command = fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5");
  REQUIRE(mpfem_command(command).exit_code == 0);
  CHECK(fs::exists(folder / "run.parts/mine.txt"));
  CHECK_FALSE(fs::exists(folder / "run.parts/snapshot-0000.h5"));
  const auto written = fs::last_write_time(folder / "run.h5");
  CHECK(mpfem_command(command + " --resume --time-limit 0.001").exit_code == 0);
  CHECK(fs::last_write_time(folder / "run.h5") == written);
  REQUIRE(mpfem_command(command + " --time-limit 0.001").exit_code == 5);
  CHECK(fs::exists(folder / "run.checkpoint.h5"));
  const Outcome anew =
      run_command(fmt::format("'{}' run {} -o {}", MPFEM_EXECUTABLE, folder / "scenario.toml", folder / "run.h5"));
  CHECK(anew.exit_code == 0);
  CHECK_THAT(anew.messages, Catch::Contains("starts again"));
}

TEST_CASE("a run may be resumed from another working folder") {
  const Folder folder;
  prepare(folder, 6);
  fs::create_directories(folder / "out");
  const std::string program = fmt::format("'{}'", MPFEM_EXECUTABLE);
  const Outcome first = run_command(fmt::format("cd '{}' && {} run scenario.toml -o out/run.h5 --quiet --set "
                                                "output.snapshot_relative_densities=[0.35] --time-limit 0.2",
                                                folder / "", program));
  REQUIRE(first.exit_code == 5);
  const Outcome second = run_command(fmt::format(
      "cd '{}' && {} run ../scenario.toml -o run.h5 --quiet --set output.snapshot_relative_densities=[0.35] --resume",
      folder / "out", program));
  INFO(second.messages);
  CHECK(second.exit_code == 0);
  CHECK(schema::FileReader(folder / "out/run.h5").snapshots().size() == 2);
}
