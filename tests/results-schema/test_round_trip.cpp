#include <bit>
#include <limits>
#include <set>

#include <catch2/catch.hpp>

#include "complete_file.hpp"
#include "temporary_folder.hpp"

using namespace mpfem;
using namespace mpfem::schema;

namespace {

template <class T>
std::vector<T> read_as(const FileReader& reader, const DatasetDescription& dataset, const std::string& snapshot) {
  switch (dataset.rank) {
  case 0:
    return {reader.read_scalar(Dataset<T, 0>{dataset}, snapshot)};
  case 1:
    return reader.read(Dataset<T, 1>{dataset}, snapshot);
  default:
    return reader.read(Dataset<T, 2>{dataset}, snapshot);
  }
}

template <class T>
void check_values(const FileReader& reader, const DatasetDescription& dataset, const test::Values& values,
                  const std::string& snapshot) {
  CHECK((read_as<T>(reader, dataset, snapshot) == test::converted<T>(values.numbers)));
}

} // namespace

TEST_CASE("Every dataset of every kind of file is read as it was written") {
  const FileKind kind = GENERATE(from_range(test::all_kinds()));
  const test::TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  test::write_complete_file(path, kind);

  const FileReader reader(path, kind);
  CHECK(reader.path() == path);
  CHECK(reader.kind() == kind);
  CHECK(reader.creator() == "mpfem tests");
  test::Extents extents; // the same names in the same order give the same extents
  for (const DatasetDescription& dataset : kinds[static_cast<std::size_t>(kind)].datasets)
    for (const std::string& snapshot : test::members_of(dataset)) {
      CAPTURE(dataset.path, snapshot);
      const test::Values values = test::good_values(dataset, extents, snapshot);
      CHECK(reader.has(dataset, snapshot));
      CHECK(reader.rows(dataset, snapshot) == values.rows);
      switch (dataset.type) {
      case ElementType::float64:
        check_values<double>(reader, dataset, values, snapshot);
        break;
      case ElementType::float32:
        check_values<float>(reader, dataset, values, snapshot);
        break;
      case ElementType::int32:
        check_values<std::int32_t>(reader, dataset, values, snapshot);
        break;
      case ElementType::int64:
        check_values<std::int64_t>(reader, dataset, values, snapshot);
        break;
      case ElementType::string:
        check_values<std::string>(reader, dataset, values, snapshot);
        break;
      }
    }
}

TEST_CASE("The schema has datasets of every element type and of rank 0, 1 and 2") {
  // Otherwise the test above would leave a way of writing untried.
  std::set<ElementType> types;
  std::set<int> ranks;
  for (const KindDescription& kind : kinds)
    for (const DatasetDescription& dataset : kind.datasets) {
      types.insert(dataset.type);
      ranks.insert(dataset.rank);
    }
  CHECK(types.size() == 5);
  CHECK(ranks == std::set<int>{0, 1, 2});
}

TEST_CASE("Numbers come back bit by bit, the extreme ones and the sign of zero included") {
  using Limits = std::numeric_limits<double>;
  const test::TemporaryFolder folder;
  const std::vector<double> written = {-0.0,    Limits::denorm_min(), Limits::max(), Limits::lowest(),
                                       1.0 / 3, Limits::epsilon()};
  {
    FileWriter writer(folder.file("f.h5"), FileKind::checkpoint, "test");
    writer.write(checkpoint::run_numbers, std::span(written), written.size());
    writer.write(checkpoint::run_integers,
                 std::span<const std::int64_t>(std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::min(),
                                                                         std::numeric_limits<std::int64_t>::max()}),
                 2);
    writer.commit();
  }
  const FileReader reader(folder.file("f.h5"));
  const std::vector<double> read = reader.read(checkpoint::run_numbers);
  REQUIRE(read.size() == written.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    CHECK(std::bit_cast<std::uint64_t>(read[i]) == std::bit_cast<std::uint64_t>(written[i]));
  CHECK(reader.read(checkpoint::run_integers) ==
        std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()});
}

TEST_CASE("Texts come back with their line ends and letters, empty ones and long ones too") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> names = {"", "Größe ≥ 0", "a\nb\tc\r\n", std::string(1'000'000, 'x')};
  {
    FileWriter writer(folder.file("f.h5"), FileKind::checkpoint, "Größe 1.0");
    writer.write(checkpoint::run_snapshots, std::span(names), names.size());
    writer.write_scalar(checkpoint::scenario, std::string("[box]\nlength = 1 # \"mm\"\n"));
    writer.write_scalar(checkpoint::packing_hash, std::string());
    writer.commit();
  }
  const FileReader reader(folder.file("f.h5"));
  CHECK(reader.creator() == "Größe 1.0");
  CHECK((reader.read(checkpoint::run_snapshots) == names));
  CHECK(reader.read_scalar(checkpoint::scenario) == "[box]\nlength = 1 # \"mm\"\n");
  CHECK(reader.read_scalar(checkpoint::packing_hash).empty());
}

TEST_CASE("Empty arrays come back empty, of every type") {
  const test::TemporaryFolder folder;
  {
    FileWriter writer(folder.file("f.h5"), FileKind::checkpoint, "test");
    writer.write(checkpoint::run_snapshots, std::span<const std::string>(), 0);
    writer.write(checkpoint::node_position, std::span<const double>(), 0);
    writer.write(checkpoint::run_integers, std::span<const std::int64_t>(), 0);
    writer.write(checkpoint::contact_candidate_facet, std::span<const std::int32_t>(), 0);
    writer.commit();
    FileWriter run_writer(folder.file("run.h5"), FileKind::run, "test");
    run_writer.write(run::snapshots_pair_grains, std::span<const std::int32_t>(), 0, "0000");
    run_writer.write(run::snapshots_node, std::span<const float>(), 0, "0000");
    run_writer.commit();
  }
  const FileReader reader(folder.file("f.h5"));
  CHECK(reader.read(checkpoint::run_snapshots).empty());
  CHECK(reader.read(checkpoint::node_position).empty());
  CHECK(reader.rows(checkpoint::node_position) == 0);
  CHECK(reader.read(checkpoint::run_integers).empty());
  CHECK(reader.read(checkpoint::contact_candidate_facet).empty());
  const FileReader run_reader(folder.file("run.h5"));
  CHECK(run_reader.read(run::snapshots_pair_grains, "0000").empty());
  CHECK(run_reader.read(run::snapshots_node, "0000").empty());
}

TEST_CASE("Snapshots are listed in ascending order and hold their own values") {
  const test::TemporaryFolder folder;
  {
    FileWriter writer(folder.file("run.h5"), FileKind::run, "test");
    for (const std::string name : {"0010", "0002", "0000"})
      writer.write_scalar(run::snapshots_time, std::stod(name), name);
    writer.commit();
  }
  const FileReader reader(folder.file("run.h5"));
  CHECK(reader.snapshots() == std::vector<std::string>{"0000", "0002", "0010"});
  for (const std::string& name : reader.snapshots())
    CHECK(reader.read_scalar(run::snapshots_time, name) == std::stod(name));
  CHECK(!reader.has(run::snapshots_time, "0001"));
  CHECK(!reader.has(run::snapshots_step, "0000"));
}

TEST_CASE("A file without snapshots lists none") {
  const test::TemporaryFolder folder;
  FileWriter(folder.file("run.h5"), FileKind::run, "test").commit();
  CHECK(FileReader(folder.file("run.h5")).snapshots().empty());
}

TEST_CASE("Large arrays of snapshots are compressed and come back bit by bit") {
  const test::TemporaryFolder folder;
  // 100 000 nodes: several chunks with a part of a chunk at the end.
  std::vector<float> node(300'000);
  for (std::size_t i = 0; i < node.size(); ++i) node[i] = static_cast<float>(i % 997) * 0.001F;
  {
    FileWriter writer(folder.file("run.h5"), FileKind::run, "test");
    writer.write(run::snapshots_node, std::span<const float>(node), node.size() / 3, "0000");
    writer.write(run::snapshots_contact_pressure, std::span<const float>(node).first(node.size() / 3), node.size() / 3,
                 "0000");
    writer.commit();
  }
  const FileReader reader(folder.file("run.h5"));
  CHECK((reader.read(run::snapshots_node, "0000") == node));
  CHECK(std::filesystem::file_size(folder.file("run.h5")) < node.size() * sizeof(float) / 2);
}
