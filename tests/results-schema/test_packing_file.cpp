// What is demanded of packings beyond the schema, whoever wrote them.

#include <functional>
#include <limits>

#include <catch2/catch.hpp>

#include "results-schema/packing_file.hpp"
#include "temporary_folder.hpp"
#include "tests/common/one_line_error.hpp"

using namespace mpfem;
using namespace mpfem::schema;
using test::input_error;

namespace {

/// Two spheres in a box, each with its own tet.
struct Contents {
  std::vector<double> lengths = {1, 2, 3};
  std::vector<double> center = {0.5, 0.5, 0.5, 0.5, 1.5, 2.5};
  std::vector<double> radius = {0.4, 0.3};
  std::vector<double> node = std::vector<double>(24, 0.5);
  std::vector<std::int32_t> tet = {0, 1, 2, 3, 4, 5, 6, 7};
  std::vector<std::int32_t> node_offset = {0, 4, 8}, tet_offset = {0, 1, 2};
  std::string shape; ///< empty: the file says nothing of it
};

void write(const std::string& path, const Contents& c) {
  FileWriter file(path, FileKind::packing, "test");
  const auto rows = [&](const auto& dataset, const auto& values, std::size_t columns) {
    using T = typename std::decay_t<decltype(values)>::value_type;
    file.write(dataset, std::span<const T>(values), values.size() / columns);
  };
  rows(packing::box_lengths, c.lengths, 1);
  if (!c.shape.empty()) file.write_scalar(packing::box_shape, c.shape);
  rows(packing::spheres_center, c.center, 3);
  rows(packing::spheres_radius, c.radius, 1);
  rows(packing::mesh_node, c.node, 3);
  rows(packing::mesh_tet, c.tet, 4);
  rows(packing::mesh_grain_node_offset, c.node_offset, 1);
  rows(packing::mesh_grain_tet_offset, c.tet_offset, 1);
  file.commit();
}

void read(const std::string& path) {
  const FileReader file(path, FileKind::packing);
  read_packing_tets(file, read_packing_spheres(file).radius.size());
}

} // namespace

TEST_CASE("A packing with valid values is read") {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("p.h5");
  Contents contents;
  contents.center[0] = 0;         // on a wall, as hemispheres are
  contents.center[5] = 3 + 1e-12; // on the other, but for rounding
  write(path, contents);
  CHECK_NOTHROW(read(path));
  const PackingSpheres spheres = read_packing_spheres(FileReader(path));
  CHECK(spheres.box_lengths == contents.lengths);
  CHECK(spheres.center == contents.center);
  CHECK(spheres.radius == contents.radius);
  const PackingTets mesh = read_packing_tets(FileReader(path), 2);
  CHECK(mesh.node == contents.node);
  CHECK(mesh.tet == contents.tet);
  CHECK(mesh.grain_node_offset == contents.node_offset);
  CHECK(mesh.grain_tet_offset == contents.tet_offset);
}

TEST_CASE("The shape of the container is a box where the file does not say otherwise") {
  const test::TemporaryFolder folder;
  Contents contents;
  contents.lengths = {2, 2, 3};
  for (const auto& [text, shape] :
       {std::pair{"", ContainerShape::box}, {"box", ContainerShape::box}, {"cylinder", ContainerShape::cylinder}}) {
    contents.shape = text;
    write(folder.file("p.h5"), contents);
    const PackingSpheres spheres = read_packing_spheres(FileReader(folder.file("p.h5")));
    CHECK(spheres.shape == shape);
    CHECK(container_volume(spheres.shape, spheres.box_lengths) ==
          Approx(shape == ContainerShape::box ? 12 : 3 * M_PI).epsilon(1e-14));
  }
}

TEST_CASE("A packing with invalid values is refused with dataset, index, what was found and what is allowed") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  struct Case {
    std::function<void(Contents&)> spoil;
    std::string message;
  };
  const std::vector<Case> cases = {
      {[](Contents& c) { c.lengths[1] = 0; }, "/box/lengths: found 0 at index 1, allowed: finite and > 0"},
      {[](Contents& c) { c.lengths[2] = infinite; }, "/box/lengths: found inf at index 2, allowed: finite and > 0"},
      {[](Contents& c) { c.radius[1] = -1; }, "/spheres/radius: found -1 at index 1, allowed: finite and > 0"},
      {[](Contents& c) { c.radius[0] = nan; }, "/spheres/radius: found nan at index 0, allowed: finite and > 0"},
      {[](Contents& c) { c.radius[0] = infinite; }, "/spheres/radius: found inf at index 0, allowed: finite and > 0"},
      {[](Contents& c) { c.center[4] = nan; }, "/spheres/center: found nan at index [1, 1], allowed: finite"},
      {[](Contents& c) { c.center[3] = 1.01; },
       "/spheres/center: found 1.01 at index [1, 0], allowed: 0 … 1, in the box"},
      {[](Contents& c) { c.center[2] = -0.01; },
       "/spheres/center: found -0.01 at index [0, 2], allowed: 0 … 3, in the box"},
      {[](Contents& c) { c.node[10] = infinite; }, "/mesh/node: found inf at index [3, 1], allowed: finite"},
      {[](Contents& c) { c.node_offset[0] = 1; }, "/mesh/grain_node_offset: found 1 at index 0, allowed: 0"},
      {[](Contents& c) { c.node_offset[1] = 0; },
       "/mesh/grain_node_offset: found 0 at index 1, allowed: more than the 0 before it"},
      {[](Contents& c) { c.node_offset[2] = 9; },
       "/mesh/grain_node_offset: found 9 at index 2, allowed: 8, the number of rows"},
      {[](Contents& c) { c.tet_offset[1] = 3; },
       "/mesh/grain_tet_offset: found 2 at index 2, allowed: more than the 3 before it"},
      {[](Contents& c) { c.tet[2] = -1; },
       "/mesh/tet: found node -1 at index [0, 2], allowed: 0 … 3, the nodes of grain 0"},
      {[](Contents& c) { c.tet[4] = 3; },
       "/mesh/tet: found node 3 at index [1, 0], allowed: 4 … 7, the nodes of grain 1"},
      {[](Contents& c) { c.tet[7] = 8; },
       "/mesh/tet: found node 8 at index [1, 3], allowed: 4 … 7, the nodes of grain 1"},
      {[](Contents& c) {
         c.center.clear(), c.radius.clear(), c.node.clear(), c.tet.clear();
         c.node_offset = c.tet_offset = {0};
       },
       "/spheres/radius: found no sphere, allowed: at least one"},
      {[](Contents& c) { c.shape = "cone\n"; }, "/box/shape: found 'cone\\n', allowed: box, cylinder, surface"},
      {[](Contents& c) { c.shape = "cylinder"; },
       "/box/lengths: found 1 and 2 at index 0 and 1, allowed: the same, the diameter of the cylinder"},
      {[](Contents& c) {
         c.shape = "cylinder", c.lengths = {2, 2, 3}, c.center = {1, 1, 1, 0.2, 0.2, 1};
       },
       "/spheres/center: found a distance of 1.13137 from the axis at index 1, allowed: 0 … 1, in the cylinder"}};
  for (const Case& c : cases) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("p.h5");
    Contents contents;
    c.spoil(contents);
    write(path, contents);
    CHECK(input_error([&] { read(path); }) == path + ": dataset " + c.message);
  }
}

TEST_CASE("Meshes for another number of spheres are refused") {
  const test::TemporaryFolder folder;
  write(folder.file("p.h5"), Contents());
  const FileReader file(folder.file("p.h5"));
  CHECK_THAT(input_error([&] { read_packing_tets(file, 3); }),
             Catch::EndsWith("dataset /mesh/grain_node_offset: found 3 values, allowed: 4, one more than there are "
                             "spheres"));
}
