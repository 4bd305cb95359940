#include <cmath>
#include <filesystem>
#include <limits>

#include <catch2/catch.hpp>

#include "complete_file.hpp"
#include "tamper.hpp"
#include "temporary_folder.hpp"

using namespace mpfem;
using namespace mpfem::schema;

namespace {

using Findings = std::vector<std::string>;

struct GoodFile {
  test::TemporaryFolder folder;
  std::string path = folder.file("file.h5");
  explicit GoodFile(FileKind kind, bool optional = true) { test::write_complete_file(path, kind, optional); }
  Findings findings() const { return validate(path).findings; }
};

/// A place of a dataset: in the first snapshot where it is of a snapshot.
std::string place_of(const DatasetDescription& dataset) {
  return path_of(dataset, test::members_of(dataset).front());
}

std::span<const DatasetDescription> datasets_of(FileKind kind) {
  return kinds[static_cast<std::size_t>(kind)].datasets;
}

} // namespace

TEST_CASE("A complete file of every kind is clean, with and without what is not required") {
  const FileKind kind = GENERATE(from_range(test::all_kinds()));
  const bool optional = GENERATE(true, false);
  CHECK(GoodFile(kind, optional).findings() == Findings{});
}

TEST_CASE("Every missing dataset is found where it is required, and only there") {
  const FileKind kind = GENERATE(from_range(test::all_kinds()));
  const GoodFile complete(kind);
  const std::string file = complete.folder.file("lacking.h5");
  for (const DatasetDescription& dataset : datasets_of(kind)) {
    std::filesystem::copy_file(complete.path, file, std::filesystem::copy_options::overwrite_existing);
    const std::string place = place_of(dataset);
    CAPTURE(place);
    test::remove_dataset(file, place);
    CHECK(validate(file).findings == (dataset.required ? Findings{place + " is missing"} : Findings{}));
  }
}

TEST_CASE("A wrong or missing unit or description of any dataset is found") {
  const FileKind kind = GENERATE(from_range(test::all_kinds()));
  const GoodFile file(kind);
  std::size_t spoilt = 0;
  {
    const Handle opened = test::open_to_write(file.path);
    for (const DatasetDescription& dataset : datasets_of(kind)) {
      const Handle set(H5Dopen2(opened, place_of(dataset).c_str(), H5P_DEFAULT), H5Dclose);
      if (spoilt++ % 2 == 0)
        test::set_text_attribute(set, "unit", "furlong\n");
      else
        H5Adelete(set, "description");
    }
  }
  const Findings findings = file.findings();
  CHECK(findings.size() == spoilt);
  CHECK_THAT(findings.front(), Catch::Contains("attribute unit is 'furlong\\n', allowed: '"));
}

TEST_CASE("A dataset that the schema does not know is found in any group") {
  const GoodFile file(FileKind::run);
  test::replace_dataset(file.path, "/extra", H5T_IEEE_F64LE, {2});
  test::replace_dataset(file.path, "/history/colour", H5T_IEEE_F64LE, {});
  test::replace_dataset(file.path, "/snapshots/0001/deep/er\n", H5T_IEEE_F64LE, {});
  const Findings findings = file.findings();
  CHECK(findings == Findings{"/extra is not in the schema", "/history/colour is not in the schema",
                             "/snapshots/0001/deep/er\\n is not in the schema"});
}

TEST_CASE("A dataset of another kind of file is unknown") {
  const GoodFile file(FileKind::packing);
  test::replace_dataset(file.path, "/history/time", H5T_IEEE_F64LE, {2});
  CHECK(file.findings() == Findings{"/history/time is not in the schema"});
}

TEST_CASE("Indices out of range are found in every dataset of indices") {
  const FileKind kind = GENERATE(from_range(test::all_kinds()));
  const double wrong = GENERATE(-1.0, 1000.0);
  for (const DatasetDescription& dataset : datasets_of(kind)) {
    if (dataset.indexes.empty()) continue;
    const GoodFile file(kind);
    const std::string place = place_of(dataset);
    test::set_value(file.path, place, 1, wrong);
    const Findings findings = file.findings();
    REQUIRE(findings.size() == 1);
    CHECK_THAT(findings.front(), Catch::StartsWith(place + " holds the index " +
                                                   std::to_string(static_cast<int>(wrong)) + ", allowed: 0 … "));
  }
}

TEST_CASE("The first index beyond the end is out of range, the last before it is not") {
  const GoodFile file(FileKind::packing);
  const auto nodes = static_cast<double>(FileReader(file.path).rows(packing::mesh_node));
  test::set_value(file.path, "/mesh/tet", 0, nodes - 1);
  CHECK(file.findings().empty());
  test::set_value(file.path, "/mesh/tet", 0, nodes);
  CHECK(file.findings().size() == 1);
}

TEST_CASE("Offsets that fall, or do not run from 0 to the end, are found") {
  const FileKind kind = GENERATE(from_range(test::all_kinds()));
  for (const DatasetDescription& dataset : datasets_of(kind)) {
    if (dataset.partitions.empty()) continue;
    const std::string place = place_of(dataset);
    CAPTURE(place);
    // Good values are 0, end, end, …
    for (const auto& [index, value] : {std::pair{std::size_t{0}, 1.0}, {std::size_t{2}, 1.0}, {std::size_t{1}, -1.0}}) {
      const GoodFile file(kind);
      test::set_value(file.path, place, index, value);
      const Findings findings = file.findings();
      REQUIRE(findings.size() == 1);
      CHECK_THAT(findings.front(), Catch::StartsWith(place + " does not rise from 0 to "));
    }
    const GoodFile file(kind);
    const auto last = FileReader(file.path).rows(dataset) - 1;
    test::set_value(file.path, place, last, 999);
    CHECK(file.findings().size() == 1);
  }
}

TEST_CASE("A number that is not finite is found in every dataset of numbers") {
  const FileKind kind = GENERATE(from_range(test::all_kinds()));
  const double wrong = GENERATE(std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity());
  const GoodFile file(kind);
  Findings expected;
  for (const DatasetDescription& dataset : datasets_of(kind)) {
    if (dataset.type != ElementType::float64 && dataset.type != ElementType::float32) continue;
    const std::size_t index = dataset.rank == 0 ? 0 : 2;
    test::set_value(file.path, place_of(dataset), index, wrong);
    expected.push_back(place_of(dataset) + (std::isnan(wrong) ? " holds nan" : " holds -inf") + " at value " +
                       std::to_string(index));
  }
  CHECK(file.findings() == expected);
}

TEST_CASE("Extents that disagree are found, with both places named") {
  const GoodFile file(FileKind::packing);
  const auto radii = FileReader(file.path).rows(packing::spheres_radius);
  test::replace_dataset(file.path, "/spheres/radius", H5T_IEEE_F64LE, {radii + 1});
  const Findings findings = file.findings();
  REQUIRE(findings.size() == 1);
  CHECK(findings.front() ==
        "/spheres/radius has " + std::to_string(radii + 1) + " spheres, /spheres/center has " + std::to_string(radii));
}

TEST_CASE("Offsets with as many values as parts lack their end and are found") {
  const GoodFile file(FileKind::packing);
  const auto offsets = FileReader(file.path).rows(packing::mesh_grain_node_offset);
  test::replace_dataset(file.path, "/mesh/grain_node_offset", H5T_STD_I32LE, {offsets - 1});
  CHECK_THAT(file.findings().front(), Catch::StartsWith("/mesh/grain_node_offset has "));
  test::replace_dataset(file.path, "/mesh/grain_node_offset", H5T_STD_I32LE, {0});
  CHECK(file.findings() == Findings{"/mesh/grain_node_offset is empty"});
}

TEST_CASE("Extents of a snapshot's own names are compared within the snapshot") {
  const GoodFile file(FileKind::run);
  {
    const FileReader reader(file.path);
    CHECK(reader.rows(run::snapshots_pair_area, "0000") != reader.rows(run::snapshots_pair_area, "0001"));
  }
  test::replace_dataset(file.path, "/snapshots/0001/pair_area", H5T_IEEE_F64LE, {1});
  const Findings findings = file.findings();
  REQUIRE(findings.size() == 1);
  CHECK_THAT(findings.front(), Catch::StartsWith("/snapshots/0001/pair_area has 1 "));
}

TEST_CASE("A wrong type, rank or fixed extent is found") {
  const GoodFile file(FileKind::run);
  test::replace_dataset(file.path, "/provenance/wall_time", H5T_IEEE_F32LE, {});
  test::replace_dataset(file.path, "/provenance/threads", H5T_STD_I32LE, {1});
  test::replace_dataset(file.path, "/snapshots/0000/box_low", H5T_IEEE_F64LE, {4});
  CHECK_THAT(file.findings(), Catch::UnorderedEquals(Findings{"/provenance/wall_time is not of type float64",
                                                              "/provenance/threads has the shape [1], allowed: scalar",
                                                              "/snapshots/0000/box_low has extent 4, allowed: [3]"}));
}

TEST_CASE("A missing creator is found") {
  const GoodFile file(FileKind::packing);
  H5Adelete(test::open_to_write(file.path), "creator");
  CHECK(file.findings() == Findings{"root attribute creator is missing"});
}

TEST_CASE("A run without snapshots is clean") {
  test::TemporaryFolder folder;
  {
    FileWriter writer(folder.file("run.h5"), FileKind::run, "test");
    test::Extents extents;
    for (const DatasetDescription& dataset : datasets_of(FileKind::run))
      if (!dataset.of_member()) test::write_values(writer, dataset, test::good_values(dataset, extents, ""), "");
    writer.commit();
  }
  CHECK(validate(folder.file("run.h5")).findings == Findings{});
}

TEST_CASE("Every tool of a run is held to the schema, and has as many rows as the history") {
  const GoodFile file(FileKind::run);
  CHECK(FileReader(file.path).tools() == test::tool_names);
  const auto rows = FileReader(file.path).rows(run::history_time);
  test::replace_dataset(file.path, "/history/tools/upper/normal_force", H5T_IEEE_F64LE, {rows + 1});
  test::replace_dataset(file.path, "/history/tools/lower/colour", H5T_IEEE_F64LE, {rows});
  CHECK(file.findings() == Findings{"/history/tools/upper/normal_force has " + std::to_string(rows + 1) +
                                        " rows, /history/time has " + std::to_string(rows),
                                    "/history/tools/lower/colour is not in the schema"});
}
