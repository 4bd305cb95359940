// Runs that are killed, interrupted or robbed of their checkpoints, through the executable.

#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/table_reader.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/scenario/read_scenario.hpp"
#include "tests/reliability/small_runs.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace fs = std::filesystem;

TEST_CASE("no rolling checkpoint is newer than the stage's or the density's that it counts as written") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  // A directory in the place of a checkpoint stands for a kill before that checkpoint: it cannot be written.
  for (const std::string blocked : {"run.first.checkpoint.h5", "run.D0.500.checkpoint.h5"}) {
    fs::create_directories(folder / (blocked + ".partial/full"));
    const Outcome stopped = run_stages(folder, "run.h5");
    INFO(stopped.messages);
    CHECK(stopped.exit_code == 4);
    fs::remove_all(folder / (blocked + ".partial"));
    CHECK(run_stages(folder, "run.h5", "--resume").exit_code == 0);
    CHECK(fs::exists(folder / blocked));
    for (const std::string name : {"first", "second", "D0.500"})
      fs::remove(folder / ("run." + name + ".checkpoint.h5"));
    fs::remove(folder / "run.h5");
  }
}

TEST_CASE("a complete run whose stage checkpoint was lost is not complete, and --resume writes it again") {
  const Folder folder;
  prepare(folder, 3, replaced(two_stages, "[output]", "[walls]\nfriction = 0.2\n[output]"));
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  REQUIRE(run_stages(folder, "whole.h5").exit_code == 0);
  for (const std::string name : {"first", "D0.500", "second"}) {
    const std::string lost = folder / ("run." + name + ".checkpoint.h5");
    REQUIRE(fs::remove(lost));
    const Outcome outcome = run_stages(folder, "run.h5", "--resume");
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.messages, Catch::Contains(name + ".checkpoint.h5 is missing"));
    CHECK(fs::exists(lost));
    CHECK(first_difference(folder / "run.h5", folder / "whole.h5").empty());
  }
  CHECK(run_stages(folder, "run.h5", "--resume").messages.find("missing") == std::string::npos);
}

TEST_CASE("an unfinished run whose stage checkpoint was lost continues from an earlier one") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "whole.h5").exit_code == 0);
  // Without its last stage's checkpoint the run cannot end: it stops with everything else done.
  fs::create_directories(folder / "run.second.checkpoint.h5.partial/full");
  REQUIRE(run_stages(folder, "run.h5").exit_code == 4);
  fs::remove_all(folder / "run.second.checkpoint.h5.partial");
  REQUIRE(fs::exists(folder / "run.checkpoint.h5"));
  REQUIRE(fs::remove(folder / "run.first.checkpoint.h5"));
  const Outcome outcome = run_stages(folder, "run.h5", "--resume");
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.messages, Catch::Contains("run.first.checkpoint.h5 is missing; the run continues from"));
  CHECK(fs::exists(folder / "run.first.checkpoint.h5"));
  CHECK(results(folder / "run.h5") == results(folder / "whole.h5"));
}

TEST_CASE("a damaged or missing rolling checkpoint falls back to the one before, and the run ends the same") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "whole.h5").exit_code == 0);
  for (const bool damaged : {true, false}) {
    fs::create_directories(folder / "run.second.checkpoint.h5.partial/full");
    REQUIRE(run_stages(folder, "run.h5").exit_code == 4);
    fs::remove_all(folder / "run.second.checkpoint.h5.partial");
    REQUIRE(fs::exists(folder / "run.checkpoint.previous.h5"));
    if (damaged)
      fs::resize_file(folder / "run.checkpoint.h5", fs::file_size(folder / "run.checkpoint.h5") / 2);
    else
      fs::remove(folder / "run.checkpoint.h5");
    const Outcome outcome = run_stages(folder, "run.h5", "--resume");
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.messages, Catch::Contains("resumed") && Catch::Contains("run.checkpoint.previous.h5"));
    if (damaged) CHECK_THAT(outcome.messages, Catch::Contains("warning") && Catch::Contains("earlier checkpoint"));
    CHECK(results(folder / "run.h5") == results(folder / "whole.h5"));
    CHECK_FALSE(fs::exists(folder / "run.checkpoint.previous.h5"));
    fs::remove(folder / "run.h5");
  }
}

TEST_CASE("a run that was killed while it tidied up is complete, and what was left is removed") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  fs::create_directories(folder / "run.parts");
  write_text(folder / "run.parts/snapshot-0001.h5", "of the time before");
  for (const std::string left : {"run.h5.partial", "run.checkpoint.next.h5", "run.first.checkpoint.h5.partial"})
    write_text(folder / left, "\x89HDF\r\n\x1a\n half written");
  CHECK(run_stages(folder, "run.h5", "--resume").exit_code == 0);
  for (const std::string left :
       {"run.parts", "run.h5.partial", "run.checkpoint.next.h5", "run.first.checkpoint.h5.partial"})
    CHECK_FALSE(fs::exists(folder / left));
}

TEST_CASE("a complete run of another scenario, packing or beginning is not replaced by --resume") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  const std::string before = read_text(folder / "run.h5"), checkpoint = folder / "first.h5";
  fs::copy_file(folder / "run.first.checkpoint.h5", checkpoint);
  write_packing(folder / "other.h5", eight_grains(4), std::vector<double>(8, 0.1));
  for (const auto& [options, what] :
       {std::pair{std::string("--set stages.1.relative_density=0.61"), "key 'stages.1.relative_density': 0.6 there"},
        std::pair{"--set packing=" + (folder / "other.h5"), "has another packing"},
        std::pair{"--from " + checkpoint, "did not begin at"}}) {
    const Outcome refused = run_stages(folder, "run.h5", "--resume " + options);
    INFO(refused.messages);
    CHECK(refused.exit_code == 2);
    CHECK(refused.one_error_line("mpfem"));
    CHECK_THAT(refused.messages, Catch::Contains(what));
    CHECK(read_text(folder / "run.h5") == before);
  }
}

TEST_CASE("a run does not write over the checkpoints of another run") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  const auto refuses = [&](const std::string& output, const std::string& kept) {
    const std::string before = read_text(folder / kept);
    for (const std::string options : {"", "--resume"}) {
      const Outcome outcome = run_stages(folder, output, options);
      INFO(outcome.messages);
      CHECK(outcome.exit_code == 2);
      CHECK(outcome.one_error_line("mpfem"));
      CHECK_THAT(outcome.messages, Catch::Contains(kept) && Catch::Contains("belongs to the run"));
      CHECK(read_text(folder / kept) == before);
    }
  };
  refuses("run.first.h5", "run.first.checkpoint.h5");
  refuses("run.D0.500.h5", "run.D0.500.checkpoint.h5");
  CHECK(run_stages(folder, "run").exit_code == 2); // its files have the names of those of run.h5
  // The other way round: the rolling checkpoint of a run that has stopped has the name of a stage's checkpoint.
  REQUIRE(run_stages(folder, "other.second.h5", "--time-limit 0.001").exit_code == 5);
  refuses("other.h5", "other.second.checkpoint.h5");
  CHECK(run_stages(folder, "run.third.h5").exit_code == 0); // no stage of run.h5
}

TEST_CASE("a checkpoint does not replace what is no checkpoint") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "named.checkpoint.h5").exit_code == 0); // a run of that name
  fs::copy_file(folder / "packing.h5", folder / "packed.first.checkpoint.h5");
  write_text(folder / "noted.second.checkpoint.h5", "notes");
  for (const auto& [output, there] :
       {std::pair{"named.h5", "named.checkpoint.h5"}, std::pair{"packed.h5", "packed.first.checkpoint.h5"},
        std::pair{"noted.h5", "noted.second.checkpoint.h5"}}) {
    const std::string before = read_text(folder / there);
    const Outcome refused = run_stages(folder, output);
    INFO(refused.messages);
    CHECK(refused.exit_code == 2);
    CHECK(refused.one_error_line("mpfem"));
    CHECK_THAT(refused.messages, Catch::Contains(there) && Catch::Contains("is no checkpoint"));
    CHECK(read_text(folder / there) == before);
  }
}

TEST_CASE("an unfinished run without a checkpoint is kept when --resume has to start again") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5", "--time-limit 0.001").exit_code == 5);
  fs::remove(folder / "run.checkpoint.h5");
  const std::string interrupted = read_text(folder / "run.h5");
  const Outcome again = run_stages(folder, "run.h5", "--resume --set stages.1.relative_density=0.61");
  INFO(again.messages);
  CHECK(again.exit_code == 0);
  CHECK_THAT(again.messages, Catch::Contains("run.h5~; no checkpoint of this run was found, so it starts again"));
  CHECK(read_text(folder / "run.h5~") == interrupted);
}

TEST_CASE("a run without --resume keeps the run that is there as RUN.h5~ and says so") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5", "--time-limit 0.001").exit_code == 5);
  const std::string interrupted = read_text(folder / "run.h5");

  const Outcome again = run_stages(folder, "run.h5");
  INFO(again.messages);
  CHECK(again.exit_code == 0);
  CHECK_THAT(again.messages, Catch::Contains("run.h5: the earlier run is kept as ") &&
                                 Catch::Contains("run.h5~; it was interrupted, and --resume would have continued it"));
  CHECK(read_text(folder / "run.h5~") == interrupted);
  CHECK(schema::validate(folder / "run.h5").empty());
  const std::string complete = read_text(folder / "run.h5");

  const Outcome third = run_stages(folder, "run.h5");
  CHECK(third.exit_code == 0);
  CHECK_THAT(third.messages, Catch::Contains("run.h5~\n") && !Catch::Contains("--resume"));
  CHECK(read_text(folder / "run.h5~") == complete); // one generation

  CHECK(run_stages(folder, "run.h5", "--resume").exit_code == 0); // already complete
  CHECK(read_text(folder / "run.h5~") == complete);
}

TEST_CASE("a run keeps an earlier one only when it begins, not when it is refused or goes on") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  const std::string before = read_text(folder / "run.h5");
  CHECK(run_stages(folder, "run.h5", "--set stages.0.relative_density=0.1").exit_code == 2);
  CHECK(read_text(folder / "run.h5") == before);
  CHECK_FALSE(fs::exists(folder / "run.h5~"));

  REQUIRE(run_stages(folder, "parts.h5", "--time-limit 0.001").exit_code == 5);
  CHECK(run_stages(folder, "parts.h5", "--resume").exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "parts.h5~"));
}

TEST_CASE("a run whose checkpoint must be written again with --resume keeps no earlier run") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  for (const std::string lost : {"run.first.checkpoint.h5", "run.second.checkpoint.h5", "run.D0.500.checkpoint.h5"})
    fs::remove(folder / lost);
  CHECK(run_stages(folder, "run.h5", "--resume").exit_code == 0);
  CHECK(fs::exists(folder / "run.first.checkpoint.h5"));
  CHECK_FALSE(fs::exists(folder / "run.h5~"));
}

TEST_CASE("what is not a run file is not replaced by a run, but an empty file is") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  write_text(folder / "notes.txt", "measured on Tuesday\n");
  write_packing(folder / "other.h5", eight_grains(3), std::vector<double>(8, 0.1));
  for (const std::string output : {"notes.txt", "other.h5"}) {
    const std::string before = read_text(folder / output);
    const Outcome refused = run_stages(folder, output);
    INFO(refused.messages);
    CHECK(refused.exit_code == 2);
    CHECK(refused.one_error_line("mpfem"));
    CHECK_THAT(refused.messages,
               Catch::EndsWith(output + ": would be replaced, which is not a run file, allowed: another --output\n"));
    CHECK(read_text(folder / output) == before);
  }

  write_text(folder / "run.h5", "");
  CHECK(run_stages(folder, "run.h5").exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "run.h5~"));
  write_text(folder / "run.h5~", "a backup by another program");
  CHECK(run_stages(folder, "run.h5").exit_code == 2); // the backup would replace it
  CHECK(read_text(folder / "run.h5~") == "a backup by another program");
}

TEST_CASE("an earlier run behind a symbolic link is kept beside the file to which the link leads") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  fs::create_directory(folder / "store");
  fs::create_symlink("store/run.h5", folder / "run.h5");
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  const std::string before = read_text(folder / "store/run.h5");
  CHECK(run_stages(folder, "run.h5").exit_code == 0);
  CHECK(fs::is_symlink(folder / "run.h5"));
  CHECK(read_text(folder / "store/run.h5~") == before);
  CHECK(schema::validate(folder / "store/run.h5").empty());
}

TEST_CASE("disk space that a run has already taken is not missing for it") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  REQUIRE(run_stages(folder, "run.h5").exit_code == 0);
  const Scenario scenario = read_scenario(TomlDocument::from_file(folder / "scenario.toml"));
  double size = 0;
  for (const auto& entry : fs::directory_iterator(folder / ""))
    if (entry.path().filename().string().starts_with("run.")) size += static_cast<double>(fs::file_size(entry));
  CHECK(size > 0);
  CHECK(size_on_disk(scenario, folder / "run.h5") == size); // whole numbers
}

TEST_CASE("a file size limit ends a run with exit code 4, not with a signal, and what was stored stays") {
  const Folder folder;
  prepare(folder, 3, two_stages);
  const Outcome outcome = run_command("ulimit -f 40; " + stages_command(folder, "run.h5"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 4);
  CHECK(outcome.one_error_line("mpfem"));
  CHECK(run_stages(folder, "run.h5", "--resume").exit_code == 0);
}

TEST_CASE("a run that is told to stop while its packing loads ends with exit code 5 and says what can be resumed") {
  const Folder folder;
  prepare(folder, 14, two_stages);
  // The lock stands before the packing is read.
  const auto stop = [&](const std::string& options) {
    return run_command(fmt::format("{} {} & pid=$!; while [ ! -e {} ] && kill -0 $pid; do :; done; kill -TERM $pid; "
                                   "wait $pid",
                                   stages_command(folder, "run.h5"), options, folder / "run.lock"));
  };
  const Outcome fresh = stop("");
  INFO(fresh.messages);
  CHECK(fresh.exit_code == 5);
  CHECK_THAT(fresh.messages, Catch::Contains("interrupted before the first step; nothing to resume"));
  CHECK_FALSE(fs::exists(folder / "run.h5"));
  CHECK_FALSE(fs::exists(folder / "run.lock"));
  REQUIRE(run_stages(folder, "run.h5", "--time-limit 0.001").exit_code == 5);
  const Outcome resumed = stop("--resume");
  INFO(resumed.messages);
  CHECK(resumed.exit_code == 5);
  CHECK_THAT(resumed.messages, Catch::Contains("run.checkpoint.h5 is unchanged; continue with --resume"));
}
