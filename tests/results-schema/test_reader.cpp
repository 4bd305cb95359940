#include <fstream>

#include <catch2/catch.hpp>

#include "complete_file.hpp"
#include "tamper.hpp"
#include "temporary_folder.hpp"
#include "tests/common/one_line_error.hpp"

using namespace mpfem;
using namespace mpfem::schema;
using test::input_error;

namespace {

std::string refusal(const std::string& path) {
  return input_error([&] { FileReader reader(path); });
}

/// A good run file to be spoilt.
struct RunFile {
  test::TemporaryFolder folder;
  std::string path = folder.file("run.h5");
  RunFile() { test::write_complete_file(path, FileKind::run); }

  template <class Read>
  std::string mistake(Read read) const {
    const FileReader reader(path, FileKind::run);
    return input_error([&] { read(reader); });
  }
};

} // namespace

TEST_CASE("A file that is missing, a folder or no HDF5 file is refused") {
  const test::TemporaryFolder folder;
  CHECK(refusal(folder.file("no.h5")) == folder.file("no.h5") + ": no such file");
  CHECK(refusal(folder.file("no\n.h5")) == folder.file("no\\n.h5") + ": no such file");
  std::filesystem::create_directory(folder.file("folder"));
  CHECK(refusal(folder.file("folder")) == folder.file("folder") + ": not a file, allowed: an HDF5 file");
  std::ofstream(folder.file("text.h5")) << "x = 1\n";
  CHECK_THAT(refusal(folder.file("text.h5")), Catch::StartsWith(folder.file("text.h5") + ": not an HDF5 file"));
}

TEST_CASE("A file cut off at any length is refused") {
  const RunFile run;
  const auto size = std::filesystem::file_size(run.path);
  const std::string cut = run.folder.file("cut.h5");
  for (const std::uintmax_t length : {std::uintmax_t{0}, std::uintmax_t{1}, std::uintmax_t{8}, std::uintmax_t{95},
                                      std::uintmax_t{512}, size / 4, size / 2, 3 * size / 4}) {
    CAPTURE(length, size);
    std::filesystem::copy_file(run.path, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, length);
    CHECK_THAT(refusal(cut), Catch::StartsWith(cut + ": not an HDF5 file that can be opened (damaged"));
    CHECK_THAT(input_error([&] { validate(cut); }), Catch::StartsWith(cut + ": "));
  }
}

TEST_CASE("A file of another kind is refused, with both kinds named") {
  const RunFile run;
  CHECK(input_error([&] { FileReader reader(run.path, FileKind::packing); }) ==
        run.path + ": a run file, allowed: a packing file");
  CHECK(FileReader(run.path).kind() == FileKind::run);
}

TEST_CASE("A file with another schema version is refused") {
  const RunFile run;
  test::set_root_attribute(run.path, "schema_version", "0.9\n");
  CHECK(refusal(run.path) == run.path + ": found schema version '0.9\\n', allowed: " + std::string(schema_version));
}

TEST_CASE("An HDF5 file of another program is refused") {
  const RunFile run;
  SECTION("without attributes") {
    const std::string other = run.folder.file("other.h5");
    Handle(H5Fcreate(other.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose).reset();
    CHECK(refusal(other) == other + ": not a file of mpfem, pack-gen or postproc (attribute file_kind is '')");
  }
  SECTION("with an unknown kind") {
    test::set_root_attribute(run.path, "file_kind", "plot");
    CHECK(refusal(run.path) ==
          run.path + ": not a file of mpfem, pack-gen or postproc (attribute file_kind is 'plot')");
  }
  SECTION("with a number for the kind") {
    const Handle file = test::open_to_write(run.path);
    H5Adelete(file, "file_kind");
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file, "file_kind", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  }
  SECTION("with several texts for the kind") {
    const Handle file = test::open_to_write(run.path);
    H5Adelete(file, "file_kind");
    const hsize_t count = 50;
    const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
    const Handle type = file_type(ElementType::string);
    const Handle attribute(H5Acreate2(file, "file_kind", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const std::vector<const char*> texts(count, "run");
    H5Awrite(attribute, type, texts.data());
  }
  CHECK_THAT(test::input_error([&] { FileReader reader(run.path, FileKind::packing); }),
             Catch::StartsWith(run.path + ": "));
}

TEST_CASE("An attribute that is a text of fixed length is read as well") {
  const RunFile run;
  {
    const Handle file = test::open_to_write(run.path);
    H5Adelete(file, "creator");
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, 5);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file, "creator", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    H5Awrite(attribute, type, "other"); // all five letters: no zero at the end
  }
  CHECK(FileReader(run.path).creator() == "other");
}

TEST_CASE("A dataset that is missing is named") {
  const RunFile run;
  test::remove_dataset(run.path, "/history/time");
  test::remove_dataset(run.path, "/snapshots/0001");
  const auto expected = [&](const std::string& name) { return run.path + ": dataset " + name + " is missing"; };
  CHECK(run.mistake([](const FileReader& r) { r.read(run::history_time); }) == expected("/history/time"));
  CHECK(run.mistake([](const FileReader& r) { r.rows(run::history_time); }) == expected("/history/time"));
  CHECK(run.mistake([](const FileReader& r) { r.read_scalar(run::snapshots_time, "0001"); }) ==
        expected("/snapshots/0001/time"));
}

TEST_CASE("A group in the place of a dataset is refused") {
  const RunFile run;
  test::remove_dataset(run.path, "/history/time");
  test::replace_dataset(run.path, "/history/time/within", H5T_IEEE_F64LE, {2});
  CHECK(run.mistake([](const FileReader& r) { r.read(run::history_time); }) ==
        run.path + ": dataset /history/time is not a dataset");
}

TEST_CASE("A dataset of another element type is refused") {
  const RunFile run;
  test::replace_dataset(run.path, "/history/time", H5T_IEEE_F32LE, {3});
  test::replace_dataset(run.path, "/history/step", H5T_STD_I32LE, {3});
  test::replace_dataset(run.path, "/provenance/host", H5T_C_S1, {});
  test::replace_dataset(run.path, "/provenance/seed", file_type(ElementType::string), {});
  CHECK(run.mistake([](const FileReader& r) { r.read(run::history_time); }) ==
        run.path + ": dataset /history/time has another element type than float64");
  CHECK(run.mistake([](const FileReader& r) { r.read(run::history_step); }) ==
        run.path + ": dataset /history/step has another element type than int64");
  CHECK(run.mistake([](const FileReader& r) { r.read_scalar(run::provenance_host); }) ==
        run.path + ": dataset /provenance/host has another element type than string");
  CHECK(run.mistake([](const FileReader& r) { r.read_scalar(run::provenance_seed); }) ==
        run.path + ": dataset /provenance/seed has another element type than int64");
}

TEST_CASE("A dataset of another shape is refused") {
  const RunFile run;
  test::replace_dataset(run.path, "/history/time", H5T_IEEE_F64LE, {3, 1});
  test::replace_dataset(run.path, "/history/wall_stress", H5T_IEEE_F64LE, {3, 5});
  test::replace_dataset(run.path, "/snapshots/0000/box_low", H5T_IEEE_F64LE, {2});
  test::replace_dataset(run.path, "/provenance/wall_time", H5T_IEEE_F64LE, {1});
  CHECK(run.mistake([](const FileReader& r) { r.read(run::history_time); }) ==
        run.path + ": dataset /history/time has the shape [3, 1], allowed: [rows]");
  CHECK(run.mistake([](const FileReader& r) { r.read(run::history_wall_stress); }) ==
        run.path + ": dataset /history/wall_stress has the shape [3, 5], allowed: [rows, 6]");
  CHECK(run.mistake([](const FileReader& r) { r.read(run::snapshots_box_low, "0000"); }) ==
        run.path + ": dataset /snapshots/0000/box_low has the shape [2], allowed: [3]");
  CHECK(run.mistake([](const FileReader& r) { r.read_scalar(run::provenance_wall_time); }) ==
        run.path + ": dataset /provenance/wall_time has the shape [1], allowed: scalar");
}

TEST_CASE("A text that was never written is empty") {
  const RunFile run;
  test::replace_dataset(run.path, "/provenance/host", file_type(ElementType::string), {});
  CHECK(FileReader(run.path).read_scalar(run::provenance_host).empty());
}
