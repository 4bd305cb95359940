// What a run leaves on disk, and files that are damaged.

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/small_runs.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;
namespace fs = std::filesystem;

TEST_CASE("snapshots show the pressure that walls and grains exert, whichever surface the contact takes") {
  // A gap read off nodes instead of contact points would show K times their height, a multiple of all stresses here.
  double largest[2] = {};
  for (const bool smooth : {false, true}) {
    const Folder folder;
    prepare(folder, 4, smooth ? with_smooth_surface(scenario_text) : scenario_text);
    REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
            0);
    const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
    const auto pressure = file.read(schema::run::snapshots_contact_pressure, file.snapshots().back());
    largest[smooth ? 1 : 0] = *std::max_element(pressure.begin(), pressure.end());
  }
  CAPTURE(largest[0], largest[1]);
  CHECK(largest[1] > 0.2 * largest[0]);
  CHECK(largest[1] < 1.5 * largest[0]);
}

TEST_CASE("files of a run hold to the schema, and the ledger closes") {
  const Folder folder;
  prepare(folder);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  CHECK(schema::validate(folder / "run.h5").empty());
  CHECK(schema::validate(folder / "packing.h5").empty());
  CHECK(schema::validate(folder / "run.compaction.checkpoint.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.snapshots().size() == 2); // at 0.52 and at the end
  CHECK(file.read_scalar(schema::run::provenance_status) == "complete");
  const auto density = file.read(schema::run::history_relative_density);
  CHECK(density.back() == Approx(0.62).epsilon(1e-12)); // the walls end exactly on target
  const auto residual = file.read(schema::run::history_energy_residual);
  const auto work = file.read(schema::run::history_external_work);
  CHECK(std::abs(residual.back()) < 0.01 * work.back());
  CHECK(file.read(schema::run::history_mean_stress).back() > 1); // it was compacted
  double accounted = 0;
  for (const double part : file.read(schema::run::provenance_profile_seconds)) accounted += part;
  CHECK(within(accounted, file.read_scalar(schema::run::provenance_wall_time), accumulated_rounding));
}

TEST_CASE("a damaged checkpoint is refused and nothing is lost") {
  const Folder folder;
  prepare(folder, 6);
  const std::string command =
      fmt::format("run {} -o {} --threads 2 --quiet --resume", folder / "scenario.toml", folder / "run.h5");
  REQUIRE(mpfem_command(command + " --time-limit 0.02").exit_code == 5);
  const std::string checkpoint = folder / "run.checkpoint.h5";
  const auto size = static_cast<std::streamoff>(fs::file_size(checkpoint));
  std::fstream file(checkpoint, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(size * 2 / 3);
  file.write("damage, damage, damage", 22);
  file.close();
  const Outcome outcome = mpfem_command(command);
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Catch::Contains("run.checkpoint.h5"));
  CHECK(fs::exists(folder / "run.h5")); // the history up to the stop
}
