// Files of runs that are damaged, written by earlier versions, or are no files at all.

#include <filesystem>

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "results-schema/file.hpp"
#include "solver/output/checkpoint.hpp"
#include "tests/results-schema/tamper.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/null_device.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;
namespace fs = std::filesystem;

namespace {

const std::string scenario_text = R"(packing = "packing.h5"
[material]
density = 1.55e-9
youngs_modulus = 5000
poissons_ratio = 0.3
[material.hardening]
law = "power"
yield_stress = 25
coefficient = 125
exponent = 0.3
[output]
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

void prepare(const Folder& folder) {
  write_packing(folder / "packing.h5", eight_grains(3), std::vector<double>(8, 0.1));
  write_text(folder / "scenario.toml", scenario_text);
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

/// The hash that earlier versions kept of a checkpoint's arrays, from HDF5's own reading.
std::string hash_of_arrays(const std::string& path) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  std::uint64_t hash = hash_seed;
  for (const char* name : {"run/integers",
                           "run/numbers",
                           "run/history",
                           "run/stage_values",
                           "run/stage_hold_rms",
                           "node/position",
                           "node/velocity",
                           "node/force",
                           "tet/deviator_xx",
                           "tet/deviator_yy",
                           "tet/deviator_xy",
                           "tet/deviator_yz",
                           "tet/deviator_zx",
                           "tet/flow_stress",
                           "tet/plastic_strain",
                           "tet/length",
                           "grain/step",
                           "grain/step_growth",
                           "node/step_contact",
                           "grain/travel",
                           "grain/travel_at_search",
                           "contact/point_wake",
                           "contact/point_sure",
                           "contact/pair_first",
                           "contact/pair_second",
                           "contact/pair_point_offset",
                           "contact/point_node",
                           "contact/point_facet_offset",
                           "contact/candidate_facet",
                           "contact/point_facet",
                           "bond/facet",
                           "bond/values",
                           "bond/laws",
                           "bond/law",
                           "grip/node",
                           "grip/side",
                           "grip/reference"}) {
    if (!schema::path_exists(file, std::string("/") + name)) continue;
    const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
    std::vector<std::byte> bytes(H5Tget_size(type) * static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    if (!bytes.empty()) REQUIRE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0);
    hash = hash_bytes(bytes, hash);
  }
  return hash_text(hash);
}

/// Makes a checkpoint as earlier versions wrote it.
void make_earlier(const std::string& path, const std::string& checksum) {
  remove_checks(path);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const Handle type = schema::file_type(schema::ElementType::string), space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle set(H5Dcreate2(file, "/checksum", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  const char* text = checksum.c_str();
  REQUIRE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text) >= 0);
}

} // namespace

TEST_CASE("a checkpoint of an earlier version is verified by the hash that it holds") {
  const Folder folder;
  prepare(folder);
  REQUIRE(run(folder, "-o first.h5").exit_code == 0);
  const std::string checkpoint = folder / "first.D0.500.checkpoint.h5";
  const auto end_from_here = [&](const std::string& output) {
    const Outcome outcome = run(folder, "--from first.D0.500.checkpoint.h5 -o " + output);
    INFO(outcome.messages);
    REQUIRE(outcome.exit_code == 0);
    return schema::FileReader(folder / output).read(schema::run::history_mean_stress);
  };
  const auto from_new = end_from_here("new.h5");
  CHECK(checkpoint_checksum(checkpoint) == schema::FileReader(checkpoint).checksums());
  CHECK(schema::FileReader(folder / "new.h5").read_scalar(schema::run::provenance_from) ==
        checkpoint_checksum(checkpoint));

  const std::string hash = hash_of_arrays(checkpoint);
  make_earlier(checkpoint, hash);
  CHECK(checkpoint_checksum(checkpoint) == hash);
  CHECK((end_from_here("earlier.h5") == from_new));

  {
    const Handle file(H5Fopen(checkpoint.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    H5Ldelete(file, "/checksum", H5P_DEFAULT);
  }
  const Outcome none = run(folder, "--from first.D0.500.checkpoint.h5 -o x.h5");
  CHECK(none.exit_code == 2);
  CHECK_THAT(none.messages, Catch::Contains("the checkpoint has no checksum"));
  make_earlier(checkpoint, hash_text(1));
  const Outcome wrong = run(folder, "--from first.D0.500.checkpoint.h5 -o x.h5");
  CHECK(wrong.exit_code == 2);
  CHECK(wrong.one_error_line("mpfem"));
  CHECK_THAT(wrong.messages, Catch::Contains("its numbers do not match its checksum"));
  CHECK_FALSE(fs::exists(folder / "x.h5"));
}

TEST_CASE("a packing with a flipped bit is refused, wherever the bit is") {
  const Folder folder;
  prepare(folder);
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

TEST_CASE("a run goes into no device, FIFO or folder, and through a link to its file") {
  const Folder folder;
  prepare(folder);
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
