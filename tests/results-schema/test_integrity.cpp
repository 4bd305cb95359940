// Damage to files, and files that were never checked.

#include <fstream>
#include <random>

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "complete_file.hpp"
#include "file_content.hpp"
#include "tamper.hpp"
#include "temporary_folder.hpp"
#include "tests/common/one_line_error.hpp"

using namespace mpfem;
using namespace mpfem::schema;
using test::content_of;
using test::input_error;

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A snapshot as mpfem run writes it beside the run: its large arrays are compressed, and the seal leaves them out.
void write_snapshot_part(const std::string& path, std::size_t nodes = 12'000) {
  std::vector<float> values(3 * nodes);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i * i % 9973) * 0.001F;
  const std::span<const float> all(values);
  FileWriter writer(path, FileKind::run, "mpfem tests");
  writer.write_scalar(run::snapshots_time, 0.25, "0000");
  writer.write(run::snapshots_node, all, nodes, "0000");
  writer.write(run::snapshots_contact_pressure, all.first(nodes), nodes, "0000");
  writer.commit();
}

/// Small files of every kind that the programs write, and one with large arrays that are not compressed.
struct Kind {
  const char* name;
  void (*write)(const std::string& path);
};

const Kind all_files[] = {
    {"spheres", [](const std::string& path) { test::write_complete_file(path, FileKind::packing, false); }},
    {"packing", [](const std::string& path) { test::write_complete_file(path, FileKind::packing); }},
    {"run", [](const std::string& path) { test::write_complete_file(path, FileKind::run); }},
    {"snapshot part", [](const std::string& path) { write_snapshot_part(path); }},
    {"checkpoint", [](const std::string& path) { test::write_complete_file(path, FileKind::checkpoint); }},
    {"large packing", [](const std::string& path) {
       std::vector<double> node(30'000);
       for (std::size_t i = 0; i < node.size(); ++i) node[i] = 0.001 * static_cast<double>(i);
       FileWriter writer(path, FileKind::packing, "mpfem tests");
       writer.write(packing::mesh_node, std::span<const double>(node), node.size() / 3);
       writer.commit();
     }}};

/// What a reader makes of bytes: "as written", "refused", or what else it read.
std::string outcome(const std::string& path, const std::string& bytes,
                    const std::map<std::string, std::string>& written) {
  write_bytes(path, bytes);
  try {
    return content_of(path) == written ? "as written" : "other values";
  } catch (const InputError& error) {
    return std::string(error.what()).starts_with(path + ": ") ? "refused" : error.what();
  }
}

} // namespace

TEST_CASE("No flipped bit and no cut makes a reader take one file for another, in any kind of file") {
  const Kind kind = GENERATE(from_range(std::begin(all_files), std::end(all_files)));
  CAPTURE(kind.name);
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  kind.write(path);
  const auto written = content_of(path);
  const std::string good = bytes_of(path);
  std::mt19937_64 random(20240607);
  std::size_t refused = 0;
  for (int i = 0; i < 120; ++i) {
    std::string bytes = good;
    const std::size_t at = random() % bytes.size();
    if (i % 6 == 0)
      bytes.resize(at);
    else
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    const std::string found = outcome(path, bytes, written);
    CAPTURE(i, at, bytes.size());
    REQUIRE((found == "as written" || found == "refused"));
    refused += found == "refused";
  }
  CHECK(refused > 110); // flips of the seal's own last bytes only take the seal away
}

TEST_CASE("Every flip in the structure of a file is seen before HDF5 reads it") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  test::write_complete_file(path, FileKind::packing);
  const std::string good = bytes_of(path);
  constexpr std::size_t magic = 16; // without these last bytes there is no seal
  for (std::size_t at = 0; at < good.size() - magic; at += 7) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << at % 8));
    write_bytes(path, bytes);
    REQUIRE(check_seal(path) == Seal::broken);
  }
  write_bytes(path, good + "more");
  CHECK(check_seal(path) == Seal::absent);
  write_bytes(path, good);
  CHECK(check_seal(path) == Seal::intact);
}

TEST_CASE("Damage to large arrays is outside the seal, and the dataset is named when it is read") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  SECTION("not compressed") {
    all_files[5].write(path);
    std::string bytes = bytes_of(path);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 16);
    write_bytes(path, bytes);
    const FileReader file(path);
    CHECK(input_error([&] { file.read(packing::mesh_node); }) ==
          path + ": dataset /mesh/node is damaged: its values do not match its checksum");
    CHECK(validate(path).findings ==
          std::vector<std::string>{"/box/lengths is missing", "/spheres/center is missing",
                                   "/spheres/radius is missing",
                                   "/mesh/node is damaged: its values do not match its checksum"});
  }
  SECTION("compressed") {
    write_snapshot_part(path, 30'000);
    std::string bytes = bytes_of(path);
    bytes[bytes.size() / 4] = static_cast<char>(bytes[bytes.size() / 4] ^ 16);
    write_bytes(path, bytes);
    const FileReader file(path);
    CHECK(file.read_scalar(run::snapshots_time, "0000") == 0.25); // what is not damaged can be read
    CHECK_THAT(input_error([&] { file.read(run::snapshots_node, "0000"); }),
               Catch::StartsWith(path + ": dataset /snapshots/0000/node is damaged: "));
  }
}

TEST_CASE("Values that another program changed do not match their checksum") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  test::write_complete_file(path, FileKind::packing);
  test::remove_seal(path);
  const std::vector<double> radii = FileReader(path).read(packing::spheres_radius);
  CHECK_FALSE(radii.empty()); // copied without its seal: as good as before
  SECTION("a value") {
    {
      const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
      const Handle set(H5Dopen2(file, "/spheres/radius", H5P_DEFAULT), H5Dclose);
      const std::vector<double> values(radii.size(), 0.5);
      H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
    CHECK(input_error([&] { FileReader(path).read(packing::spheres_radius); }) ==
          path + ": dataset /spheres/radius is damaged: its values do not match its checksum");
  }
  SECTION("a unit") {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const Handle set(H5Dopen2(file, "/spheres/radius", H5P_DEFAULT), H5Dclose);
    test::set_text_attribute(set, attribute::unit, "m");
    H5Fflush(file, H5F_SCOPE_GLOBAL);
    CHECK_THAT(input_error([&] { FileReader(path).read(packing::spheres_radius); }),
               Catch::Contains("/spheres/radius is damaged"));
  }
}

TEST_CASE("A dataset that is lost, added, renamed or without its checksum is noticed at opening") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  test::write_complete_file(path, FileKind::packing);
  test::remove_seal(path);
  {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const std::string change = GENERATE("lost", "added", "renamed", "unchecked", "creator");
    if (change == "lost") H5Ldelete(file, "/packing/seed", H5P_DEFAULT);
    if (change == "added") {
      const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
      H5Dclose(H5Dcreate2(file, "/packing/new", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    }
    if (change == "renamed") H5Lmove(file, "/packing/seed", file, "/packing/sown", H5P_DEFAULT, H5P_DEFAULT);
    if (change == "unchecked")
      H5Adelete(Handle(H5Dopen2(file, "/packing/seed", H5P_DEFAULT), H5Dclose), attribute::checksum);
    if (change == "creator") test::set_text_attribute(file, attribute::creator, "someone else");
    CAPTURE(change);
  }
  CHECK_THAT(input_error([&] { FileReader reader(path); }),
             Catch::StartsWith(path + ": the file is damaged: its list of datasets does not match its checksum"));
  CHECK_THAT(validate(path).findings, Catch::VectorContains(std::string(
                                          "the file is damaged: its list of datasets does not match its checksum (a "
                                          "dataset is lost, added, renamed or changed)")));
}

TEST_CASE("A file without checksums is read as before, and validate says that it has none") {
  const Kind kind = GENERATE(from_range(std::begin(all_files), std::end(all_files)));
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  kind.write(path);
  const auto written = content_of(path);
  const Validation checked = validate(path);
  CHECK(checked.checked);
  test::remove_checks(path);
  CHECK(content_of(path) == written);
  const Validation unchecked = validate(path);
  CHECK_FALSE(unchecked.checked);
  CHECK(unchecked.findings == checked.findings);
  CHECK(FileReader(path).checksums().empty());
}

TEST_CASE("The hash of a whole file tells its content from others and depends on nothing else") {
  const test::TemporaryFolder folder;
  const std::string one = folder.file("one.h5"), two = folder.file("two.h5"), other = folder.file("other.h5");
  write_snapshot_part(one);
  write_snapshot_part(two);
  write_snapshot_part(other, 12'001);
  CHECK(FileReader(one).checksums().size() == 16);
  CHECK(FileReader(one).checksums() == FileReader(two).checksums());
  CHECK(FileReader(one).checksums() != FileReader(other).checksums());
}

TEST_CASE("A snapshot that is copied to another file is what it was") {
  const test::TemporaryFolder folder;
  const std::string from = folder.file("from.h5"), to = folder.file("to.h5");
  test::write_complete_file(from, FileKind::run);
  {
    const FileReader reader(from);
    FileWriter writer(to, FileKind::run, "test");
    writer.copy_snapshot(reader, "0001", "0000");
    writer.copy_snapshot(reader, "0000", "0001");
    writer.commit();
  }
  const auto before = content_of(from), after = content_of(to);
  std::size_t compared = 0;
  for (const auto& [path, bytes] : before) {
    if (!path.starts_with("/snapshots/")) continue;
    const std::string swapped = path.substr(0, 14) + (path[14] == '0' ? '1' : '0') + path.substr(15);
    CAPTURE(path, swapped);
    CHECK(after.at(swapped) == bytes);
    ++compared;
  }
  CHECK(compared == after.size());
  CHECK(compared > 40);
}

TEST_CASE("Extents that the file cannot hold are refused before memory is taken for them") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  test::write_complete_file(path, FileKind::packing, false);
  const auto replace = [&](const std::vector<hsize_t>& extents, bool compressed) {
    test::remove_checks(path);
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    H5Ldelete(file, "/spheres/center", H5P_DEFAULT);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (compressed) {
      const hsize_t chunk[] = {64, 3};
      H5Pset_chunk(creation, 2, chunk);
      H5Pset_deflate(creation, 1);
    }
    const Handle space(H5Screate_simple(2, extents.data(), nullptr), H5Sclose);
    const Handle set(H5Dcreate2(file, "/spheres/center", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                     H5Dclose);
    REQUIRE(set);
  };
  for (const hsize_t rows : {hsize_t{1} << 20, hsize_t{1} << 40, hsize_t{1} << 61})
    for (const bool compressed : {false, true}) {
      if (rows > hsize_t{1} << 40 && !compressed) continue; // HDF5 itself refuses to make it
      replace({rows, 3}, compressed);
      CAPTURE(rows, compressed);
      CHECK_THAT(input_error([&] { FileReader(path).read(packing::spheres_center); }),
                 Catch::StartsWith(path + ": dataset /spheres/center has the shape [" + std::to_string(rows) +
                                   ", 3], more values than a file of "));
      const auto findings = validate(path).findings;
      CHECK(std::any_of(findings.begin(), findings.end(), [](const std::string& finding) {
        return finding.starts_with("/spheres/center has the shape [") &&
               finding.find("more values than a file of ") != std::string::npos;
      }));
    }
  replace({200, 3}, true); // a few values that compress well
  CHECK(FileReader(path).read(packing::spheres_center).size() == 600);
}

TEST_CASE("A file is written neither over a folder nor over a FIFO") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("f.h5");
  SECTION("a folder") {
    std::filesystem::create_directory(path);
    CHECK(input_error([&] { FileWriter(path, FileKind::packing, "test"); }) ==
          "output " + path + ": found a folder, allowed: a file");
  }
  SECTION("a FIFO") {
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    CHECK(input_error([&] { FileWriter(path, FileKind::packing, "test"); }) ==
          "output " + path + ": found a FIFO, allowed: a file");
    CHECK(std::filesystem::is_fifo(path));
  }
  CHECK(folder.entries() == 1);
}

TEST_CASE("A symbolic link is kept, and what it leads to is written") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("store"));
  std::filesystem::create_symlink("store/real.h5", folder.file("link.h5"));
  write_snapshot_part(folder.file("link.h5"));
  CHECK(std::filesystem::is_symlink(folder.file("link.h5")));
  CHECK(std::filesystem::is_regular_file(folder.file("store/real.h5")));
  CHECK(content_of(folder.file("link.h5")).size() == 3);
}
