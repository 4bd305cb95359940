// Files of runs that are damaged, written by earlier versions, or are no files at all.

#include <filesystem>

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "results-schema/file.hpp"
#include "solver/output/checkpoint.hpp"
#include "tests/results-schema/tamper.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/null_device.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;
namespace fs = std::filesystem;

namespace {

const std::string short_scenario = material_text + R"([output]
history_rows = 20
checkpoint_relative_densities = [0.5]
snapshot_relative_densities = [0.5]
[[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = 0.56
wall_speed = 20000
damping_rate = 1e6
damping_fade_stress = 5
)";

void prepare_short_run(const Folder& folder) {
  write_packing(folder / "packing.h5", eight_grains(3), std::vector<double>(8, 0.1));
  write_text(folder / "scenario.toml", short_scenario);
}

Outcome run(const Folder& folder, const std::string& arguments) {
  return run_command(fmt::format("cd '{}' && '{}' run scenario.toml --threads 1 --quiet {}", folder / "",
                                 MPFEM_EXECUTABLE, arguments));
}

void flip_a_bit(const std::string& path, double share) {
  std::string bytes = read_text(path);
  char& byte = bytes[static_cast<std::size_t>(share * static_cast<double>(bytes.size()))];
  byte = static_cast<char>(byte ^ 8);
  write_text(path, bytes);
}

} // namespace

TEST_CASE("a checkpoint without checksums, as earlier versions wrote them, is refused") {
  const Folder folder;
  prepare_short_run(folder);
  REQUIRE(run(folder, "-o first.h5").exit_code == 0);
  const std::string checkpoint = folder / "first.D0.500.checkpoint.h5";
  CHECK(checkpoint_checksum(checkpoint) == schema::FileReader(checkpoint).checksums());
  REQUIRE(run(folder, "--from first.D0.500.checkpoint.h5 -o new.h5").exit_code == 0);
  CHECK(schema::FileReader(folder / "new.h5").read_scalar(schema::run::provenance_from) ==
        checkpoint_checksum(checkpoint));
  remove_checks(checkpoint);
  const Outcome outcome = run(folder, "--from first.D0.500.checkpoint.h5 -o x.h5");
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.one_error_line("mpfem"));
  CHECK_THAT(outcome.messages, Catch::Contains("the checkpoint has no checksum"));
  CHECK_FALSE(fs::exists(folder / "x.h5"));
}

TEST_CASE("a packing with one flipped bit, at any place, is refused") {
  const Folder folder;
  prepare_short_run(folder);
  const std::string good = read_text(folder / "packing.h5");
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    write_text(folder / "packing.h5", good);
    flip_a_bit(folder / "packing.h5", share);
    const Outcome outcome = run(folder, "-o run.h5");
    INFO(share << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("mpfem"));
    CHECK_THAT(outcome.messages, Catch::Contains("packing.h5: ") && Catch::Contains("damaged"));
    CHECK_FALSE(fs::exists(folder / "run.h5"));
  }
}

TEST_CASE("a run is not written to a device, FIFO or folder, and follows a link to a file") {
  const Folder folder;
  prepare_short_run(folder);
  REQUIRE(mkfifo((folder / "fifo").c_str(), 0600) == 0);
  std::vector<std::pair<std::string, std::string>> cases = {{"fifo", "found a FIFO"}, {".", "found a folder"}};
  if (make_null_device(folder / "null")) cases.emplace_back("null", "found a character device");
  for (const auto& [output, found] : cases) {
    const Outcome outcome = run(folder, "-o " + output);
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("mpfem"));
    CHECK_THAT(outcome.messages, Catch::Contains("--output " + output + ": " + found + ", allowed: a file"));
  }
  CHECK(fs::is_fifo(folder / "fifo"));
  CHECK((cases.size() == 2 || fs::is_character_file(folder / "null")));
  fs::create_directory(folder / "store");
  fs::create_symlink("store/run.h5", folder / "run.h5");
  CHECK(run(folder, "-o run.h5").exit_code == 0);
  CHECK(fs::is_symlink(folder / "run.h5"));
  CHECK(schema::validate(folder / "store/run.h5").empty());
}
