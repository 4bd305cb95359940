// Arrays that are written and read piece by piece.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "results-schema/file.hpp"
#include "tamper.hpp"
#include "temporary_folder.hpp"
#include "tests/common/one_line_error.hpp"

using namespace mpfem;
using namespace mpfem::schema;

using test::input_error;

namespace {

using Doubles = std::span<const double>;

/// Different from place to place.
std::vector<double> some_numbers(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = std::sin(static_cast<double>(i));
  return values;
}

/// Writes rows of three in pieces of so many rows, the last piece of what is left.
void append_rows(FileWriter& writer, Doubles values, std::size_t rows_of_piece) {
  for (; !values.empty();) {
    const std::size_t piece = std::min(values.size(), 3 * rows_of_piece);
    writer.append(values.first(piece));
    values = values.subspan(piece);
  }
}

/// Reads node positions of a packing piece by piece.
std::vector<double> read_nodes(const FileReader& file, std::vector<std::size_t>* first_rows = nullptr) {
  std::vector<double> values;
  file.read_in_pieces(packing::mesh_node, [&](std::size_t first_row, Doubles piece) {
    REQUIRE(piece.size() % 3 == 0);
    REQUIRE(first_row == values.size() / 3);
    if (first_rows) first_rows->push_back(first_row);
    values.insert(values.end(), piece.begin(), piece.end());
  });
  return values;
}

} // namespace

TEST_CASE("An array written in pieces is the one written at once, checksum and all") {
  const std::size_t rows = GENERATE(0U, 1U, 1000U, 400'000U); // the last are 9.6 MB
  const std::vector<double> nodes = some_numbers(3 * rows);
  const test::TemporaryFolder folder;
  {
    FileWriter writer(folder.file("whole.h5"), FileKind::packing, "test");
    writer.write(packing::mesh_node, Doubles(nodes), rows);
    writer.commit();
  }
  for (const std::size_t rows_of_piece : {1U, 999U, 250'000U}) {
    if (rows / rows_of_piece > 1000) continue; // a hundred thousand pieces take too long
    FileWriter writer(folder.file("pieces.h5"), FileKind::packing, "test");
    writer.begin(packing::mesh_node, rows, 3);
    append_rows(writer, nodes, rows_of_piece);
    writer.commit();
    const FileReader whole(folder.file("whole.h5")), pieces(folder.file("pieces.h5"));
    CHECK((pieces.read(packing::mesh_node) == nodes));
    CHECK(pieces.checksums() == whole.checksums());
  }
}

TEST_CASE("A large array of a snapshot is written in pieces and compressed") {
  const std::size_t rows = 100'000;
  const std::vector<float> velocity(3 * rows, 0.25F);
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("f.h5"), FileKind::run, "test");
  writer.begin(run::snapshots_velocity, rows, 3, "0000");
  for (std::size_t row = 0; row < rows; row += 7000)
    writer.append(std::span<const float>(velocity).subspan(3 * row, 3 * std::min<std::size_t>(7000, rows - row)));
  writer.commit();
  CHECK(std::filesystem::file_size(folder.file("f.h5")) < rows);
  CHECK((FileReader(folder.file("f.h5")).read(run::snapshots_velocity, "0000") == velocity));
}

TEST_CASE("Snapshots are listed by their number, beyond 9999 too") {
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("f.h5"), FileKind::run, "test");
  for (const char* number : {"10000", "0000", "9999"}) writer.write_scalar(run::snapshots_time, 0.25, number);
  writer.commit();
  CHECK((FileReader(folder.file("f.h5")).snapshots() == std::vector<std::string>{"0000", "9999", "10000"}));
}

TEST_CASE("An array is read in pieces of whole rows, in order") {
  const std::size_t rows = GENERATE(0U, 1U, 1000U, 400'000U);
  const std::vector<double> nodes = some_numbers(3 * rows);
  const test::TemporaryFolder folder;
  FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
  writer.write(packing::mesh_node, Doubles(nodes), rows);
  writer.commit();
  std::vector<std::size_t> first_rows;
  CHECK((read_nodes(FileReader(folder.file("f.h5")), &first_rows) == nodes));
  CHECK(first_rows.size() == (rows == 0 ? 0 : rows <= 1000 ? 1 : 3));
}

TEST_CASE("Damage in any piece is seen at the end of the reading") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("f.h5");
  const std::size_t rows = 400'000;
  FileWriter writer(path, FileKind::packing, "test");
  writer.write(packing::mesh_node, Doubles(some_numbers(3 * rows)), rows);
  writer.commit();
  const std::size_t size = std::filesystem::file_size(path);
  for (const double share : {0.1, 0.5, 0.9}) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto place = static_cast<std::streamoff>(share * static_cast<double>(size));
    file.seekg(place);
    const auto good = static_cast<char>(file.get());
    file.seekp(place);
    file.put(static_cast<char>(good ^ 1));
    file.close();
    const FileReader reader(path);
    CHECK(input_error([&] { read_nodes(reader); }) ==
          path + ": dataset /mesh/node is damaged: its values do not match its checksum");
    CHECK(input_error([&] { reader.verify(); }) ==
          path + ": dataset /mesh/node is damaged: its values do not match its checksum");
    file.open(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(place);
    file.put(good);
  }
  CHECK_NOTHROW(read_nodes(FileReader(path)));
}

TEST_CASE("What is missing or of another shape is refused before a piece is read") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("f.h5");
  FileWriter writer(path, FileKind::packing, "test");
  writer.write(packing::mesh_node, Doubles(some_numbers(12)), 4);
  writer.commit();
  CHECK(input_error([&] {
          FileReader(path).read_in_pieces(packing::spheres_radius,
                                          [](std::size_t, Doubles) { FAIL("nothing is there"); });
        }) == path + ": dataset /spheres/radius is missing");
  test::replace_dataset(path, "/mesh/node", H5T_NATIVE_DOUBLE, {4, 2});
  CHECK(input_error([&] { read_nodes(FileReader(path)); }) ==
        path + ": dataset /mesh/node has the shape [4, 2], allowed: [nodes, 3]");
}

TEST_CASE("Pieces that are not the rows still to come are refused") {
  const test::TemporaryFolder folder;
  const std::vector<double> numbers = some_numbers(12);
  const Doubles all(numbers);
  FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
  CHECK_THROWS_AS(writer.append(all.first(3)), std::logic_error); // nothing is begun
  CHECK_THROWS_AS(writer.begin(packing::mesh_node, 4, 2), std::logic_error);
  writer.begin(packing::mesh_node, 4, 3);
  CHECK_THROWS_AS(writer.append(all.first(4)), std::logic_error); // half a row
  const std::vector<float> floats(3, 0.0F);
  CHECK_THROWS_AS(writer.append(std::span<const float>(floats)), std::logic_error);
  writer.append(all.first(9));
  CHECK_THROWS_AS(writer.append(all.first(6)), std::logic_error); // one row too many
  CHECK_THROWS_AS(writer.begin(packing::spheres_radius, 4), std::logic_error);
  CHECK_THROWS_AS(writer.write(packing::spheres_radius, all.first(4), 4), std::logic_error);
  CHECK_THROWS_AS(writer.commit(), std::logic_error); // not complete
  writer.append(all.last(3));
  CHECK_THROWS_AS(writer.append(all.first(3)), std::logic_error);
  CHECK_THROWS_AS(writer.begin(packing::mesh_node, 4, 3), std::logic_error); // twice
  writer.commit();
  CHECK((FileReader(folder.file("f.h5")).read(packing::mesh_node) == numbers));
}

TEST_CASE("Extents of one name agree between arrays written in pieces and at once") {
  const test::TemporaryFolder folder;
  const std::vector<double> numbers = some_numbers(12);
  FileWriter writer(folder.file("f.h5"), FileKind::packing, "test");
  writer.write(packing::spheres_radius, Doubles(numbers).first(4), 4);
  CHECK_THROWS_AS(writer.begin(packing::spheres_center, 3, 3), std::logic_error);
  CHECK_NOTHROW(writer.begin(packing::spheres_center, 4, 3));
}
