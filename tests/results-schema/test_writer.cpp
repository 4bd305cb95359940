#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "complete_file.hpp"
#include "temporary_folder.hpp"

using namespace mpfem;
using namespace mpfem::schema;

namespace {

using Doubles = std::span<const double>;
const std::vector<double> numbers(100, 1.0);

Doubles some(std::size_t count) {
  return Doubles(numbers).first(count);
}

/// A file that stood there before.
void write_older(const std::string& path) {
  FileWriter writer(path, FileKind::packing, "older");
  writer.commit();
}

/// Files of this process end at so many bytes, as on a full disk, while this object lives.
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  rlimit before_{};
  void (*handler_)(int);
};

} // namespace

TEST_CASE("A file that is not committed leaves nothing behind") {
  const test::TemporaryFolder folder;
  {
    FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
    writer.write(packing::box_lengths, some(3), 3);
    CHECK(std::filesystem::exists(folder.file("f.h5.partial")));
    CHECK(!std::filesystem::exists(folder.file("f.h5")));
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("A file that is not committed keeps the older one, a committed one replaces it") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("f.h5");
  write_older(path);
  {
    FileWriter writer(path, FileKind::packing, "newer");
    writer.write(packing::box_lengths, some(3), 3);
  }
  CHECK(folder.entries() == 1);
  CHECK(FileReader(path).creator() == "older");
  {
    FileWriter writer(path, FileKind::packing, "newer");
    writer.write(packing::box_lengths, some(3), 3);
    CHECK(FileReader(path).creator() == "older");
    writer.commit();
  }
  CHECK(folder.entries() == 1);
  CHECK(FileReader(path).creator() == "newer");
}

TEST_CASE("A stale partial file does not hinder the next") {
  const test::TemporaryFolder folder;
  std::ofstream(folder.file("f.h5.partial")) << "left by a crash";
  FileWriter(folder.file("f.h5"), FileKind::packing, "test").commit();
  CHECK(folder.entries() == 1);
  CHECK_NOTHROW(FileReader(folder.file("f.h5")));
}

TEST_CASE("Values that do not fill the shape are refused") {
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
  CHECK_THROWS_AS(writer.write(packing::box_lengths, some(2), 2), std::logic_error); // fixed extent 3
  CHECK_THROWS_AS(writer.write(packing::box_lengths, some(4), 4), std::logic_error);
  CHECK_THROWS_AS(writer.write(packing::box_lengths, some(3), 4), std::logic_error);    // rows against values
  CHECK_THROWS_AS(writer.write(packing::spheres_center, some(7), 2), std::logic_error); // 2 rows of 3
  CHECK_THROWS_AS(writer.write(packing::spheres_center, some(6), 3), std::logic_error);
  CHECK_THROWS_AS(writer.write(packing::spheres_center, some(3), 0), std::logic_error);
  CHECK_THROWS_AS(writer.write(packing::spheres_radius, some(5), 4), std::logic_error);
}

TEST_CASE("Extents of one name must agree in a file") {
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
  writer.write(packing::spheres_radius, some(5), 5);
  CHECK_THROWS_AS(writer.write(packing::spheres_center, some(12), 4), std::logic_error);
  CHECK_NOTHROW(writer.write(packing::spheres_center, some(15), 5));
  const std::vector<std::int32_t> offsets(6, 0);
  const std::span<const std::int32_t> all(offsets);
  CHECK_THROWS_AS(writer.write(packing::mesh_grain_node_offset, all.first(5), 5), std::logic_error);
  CHECK_NOTHROW(writer.write(packing::mesh_grain_node_offset, all, 6));
  // Offsets have an end, so at least one value.
  FileWriter other(folder.file("g.h5"), FileKind::packing, "test");
  CHECK_THROWS_AS(other.write(packing::mesh_grain_node_offset, all.first(0), 0), std::logic_error);
}

TEST_CASE("Extents of a snapshot's own names must agree within it only") {
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("run.h5"), FileKind::run, "test");
  writer.write(run::snapshots_pair_area, some(4), 4, "0000");
  writer.write(run::snapshots_pair_area, some(2), 2, "0001");
  CHECK_THROWS_AS(writer.write(run::snapshots_pair_force, some(6), 2, "0000"), std::logic_error);
  CHECK_NOTHROW(writer.write(run::snapshots_pair_force, some(12), 4, "0000"));
  CHECK_NOTHROW(writer.write(run::snapshots_pair_force, some(6), 2, "0001"));
}

TEST_CASE("A snapshot's dataset needs the snapshot's name, and no other takes one") {
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("run.h5"), FileKind::run, "test");
  CHECK_THROWS_AS(writer.write_scalar(run::snapshots_time, 1.0), std::logic_error);
  CHECK_THROWS_AS(writer.write(run::history_time, some(2), 2, "0000"), std::logic_error);
}

TEST_CASE("A dataset of another kind of file, a second writing, or writing after the end is refused") {
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
  CHECK_THROWS_AS(writer.write(run::history_time, some(2), 2), std::logic_error);
  writer.write(packing::box_lengths, some(3), 3);
  CHECK_THROWS_AS(writer.write(packing::box_lengths, some(3), 3), std::logic_error);
  writer.commit();
  CHECK_THROWS_AS(writer.write(packing::spheres_radius, some(3), 3), std::logic_error);
  CHECK_THROWS_AS(writer.commit(), std::logic_error);
}

TEST_CASE("A refused writing leaves the file as good as it was") {
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
  CHECK_THROWS_AS(writer.write(packing::spheres_center, some(7), 2), std::logic_error);
  writer.write(packing::box_lengths, some(3), 3);
  writer.write(packing::spheres_center, some(6), 2);
  writer.write(packing::spheres_radius, some(2), 2);
  writer.commit();
  CHECK(validate(folder.file("f.h5")).findings.empty());
}

TEST_CASE("A folder that is missing, is a file, or cannot be written gives a StorageError") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(FileWriter(folder.file("missing/f.h5"), FileKind::packing, "test"), StorageError);
  std::ofstream(folder.file("plain")) << "x";
  CHECK_THROWS_AS(FileWriter(folder.file("plain/f.h5"), FileKind::packing, "test"), StorageError);
  if (geteuid() != 0) { // permissions do not bind the superuser
    std::filesystem::create_directory(folder.file("locked"));
    std::filesystem::permissions(folder.file("locked"),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    CHECK_THROWS_AS(FileWriter(folder.file("locked/f.h5"), FileKind::packing, "test"), StorageError);
  }
}

TEST_CASE("A complete file whose place is taken by a folder is kept beside it and named") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("f.h5");
  {
    FileWriter writer(path, FileKind::packing, "test");
    std::filesystem::create_directories(path + "/within"); // meanwhile
    CHECK_THROWS_WITH(writer.commit(), Catch::Contains("f.h5.partial could not be renamed"));
  }
  CHECK_NOTHROW(FileReader(path + ".partial"));
}

TEST_CASE("A program that has met a full disk still ends with its own exit code") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("f.h5");
  const std::vector<double> many(1'000'000, 1.0);
  std::cout.flush();
  std::fflush(nullptr); // or the child would write what this process has yet to write
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    try {
      const FileSizeLimit limit(64 * 1024);
      FileWriter writer(path, FileKind::packing, "test");
      writer.write(packing::spheres_radius, Doubles(many), many.size());
      writer.commit();
    } catch (const StorageError&) {
      std::exit(4); // with all clearing up at the end of a program
    }
    std::exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status)); // not ended by a signal
  CHECK(WEXITSTATUS(status) == 4);
}

TEST_CASE("A disk that fills up gives a StorageError, leaves nothing and keeps the older file") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("f.h5");
  write_older(path);
  const std::vector<double> many(1'000'000, 1.0);
  const auto write_until_full = [&] {
    const FileSizeLimit limit(64 * 1024);
    FileWriter writer(path, FileKind::packing, "newer");
    writer.write(packing::spheres_radius, Doubles(many), many.size());
    writer.commit();
  };
  CHECK_THROWS_AS(write_until_full(), StorageError);
  CHECK(folder.entries() == 1);
  CHECK(FileReader(path).creator() == "older");
}
