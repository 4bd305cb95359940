// What is drawn of rigid tools: where they stand in a snapshot, their sections and their surfaces.

#include <cmath>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "postproc/drawing/section_picture.hpp"
#include "postproc/drawing/tool_outline.hpp"
#include "postproc/drawing/tool_surface.hpp"
#include "postproc/drawing/vtk.hpp"
#include "postproc/picture/picture_scene.hpp"
#include "postproc/view/view_data.hpp"
#include "tests/support/folder.hpp"
#include "tool_run.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Snapshot snapshot_of(const RunContents& run) {
  const Folder folder;
  write_run(folder / "run.h5", run);
  CHECK(schema::validate(folder / "run.h5").findings.empty());
  return read_snapshot({folder / "run.h5", schema::FileKind::run}, 0);
}

std::vector<ToolBody> bodies_of(const Snapshot& snapshot) {
  return tool_bodies(snapshot, drawn_extent(snapshot));
}

/// A snapshot with one tool in place.
Snapshot with_tool(const ToolGeometry& tool) {
  Snapshot snapshot = snapshot_of(small_run());
  snapshot.tools = {tool};
  return snapshot;
}

/// mm^2, that pieces of an outline enclose: over slices along the plane's second coordinate, by the midpoint rule.
double area_within(const std::vector<OutlinePiece>& pieces) {
  constexpr int slices = 20000;
  double low = 1e300, high = -1e300, area = 0;
  for (const OutlinePiece& piece : pieces)
    for (const double v : {piece.from[1], piece.to[1]}) low = std::min(low, v), high = std::max(high, v);
  for (int i = 0; i < slices; ++i) {
    const double v = low + (high - low) * (i + 0.5) / slices;
    std::vector<double> crossing;
    for (const auto& [from, to] : pieces)
      if ((from[1] <= v) != (to[1] <= v))
        crossing.push_back(from[0] + (v - from[1]) / (to[1] - from[1]) * (to[0] - from[0]));
    REQUIRE(crossing.size() % 2 == 0);
    std::sort(crossing.begin(), crossing.end());
    for (std::size_t k = 0; k + 1 < crossing.size(); k += 2) area += crossing[k + 1] - crossing[k];
  }
  return area * (high - low) / slices;
}

double volume_of(const Snapshot& tets, std::int32_t body) {
  double six = 0;
  for (std::size_t t = 0; t < tets.tets(); ++t) {
    if (tets.tet_grain[t] != body) continue;
    Eigen::Vector3d x[4];
    for (std::size_t c = 0; c < 4; ++c)
      x[c] = Eigen::Vector3f(tets.node.data() + 3 * static_cast<std::size_t>(tets.tet[4 * t + c])).cast<double>();
    const double of_tet = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
    CHECK(of_tet >= 0);
    six += of_tet;
  }
  return six / 6;
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> bounds_of(const std::vector<SolidTriangle>& triangles) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
  for (const SolidTriangle& t : triangles)
    for (const SolidVertex& vertex : t.corner)
      low = low.cwiseMin(vertex.position), high = high.cwiseMax(vertex.position);
  return {low, high};
}

/// Of 120 corners over that of the circle.
const double share_of_circle = 120 * std::sin(2 * M_PI / 120) / (2 * M_PI);

} // namespace

TEST_CASE("a snapshot has the tools that are in place, where they stand, and no others") {
  const Snapshot snapshot = snapshot_of(die_run());
  REQUIRE(snapshot.tools.size() == 3);
  CHECK(snapshot.tools[0].name == "die");
  CHECK(snapshot.tools[0].shape == ToolKind::cylinder);
  CHECK(snapshot.tools[0].inside);
  CHECK(snapshot.tools[0].half_length == 1.65);
  CHECK(std::abs(snapshot.tools[1].point[2] + 1.4) < 1e-15);
  CHECK(std::abs(snapshot.tools[2].point[2] - 1.5) < 1e-15);
  RunContents none = die_run();
  none.extents["*tools"] = 0;
  none.texts["/snapshots/*/tool_name"] = {};
  none.numbers["/snapshots/*/tool_displacement"] = {};
  CHECK(snapshot_of(none).tools.empty());
  CHECK(snapshot_of(small_run()).tools.empty());
}

TEST_CASE("a tool of an unknown shape, or off the axes, is refused with its name") {
  RunContents run = die_run();
  run.texts["/tools/die/shape"] = {"torus"};
  CHECK_THROWS_WITH(snapshot_of(run), Catch::Contains("tool 'die': shape 'torus', allowed: plane, cylinder"));
  run = die_run();
  run.numbers["/tools/die/direction"] = {0.6, 0, 0.8};
  CHECK_THROWS_WITH(snapshot_of(run), Catch::Contains("allowed: a unit vector along x, y or z"));
}

TEST_CASE("a section across a die has its bore as a circle, one along it its wall as lines") {
  const Snapshot snapshot = snapshot_of(die_run());
  const std::vector<ToolBody> bodies = bodies_of(snapshot);
  REQUIRE(bodies.size() == 3);
  const double back = 2 + drawn_extent(snapshot).thickness;
  std::size_t on_bore = 0, on_back = 0;
  for (const OutlinePiece& piece : section_outline(bodies[0], {2, 0.3}))
    for (const auto& x : {piece.from, piece.to}) {
      const double radius = std::hypot(x[0], x[1]);
      on_bore += std::abs(radius - 2) < 1e-12;
      on_back += std::abs(radius - back) < 1e-12;
    }
  CHECK(on_bore == 720);
  CHECK(on_back == 720);
  for (const int axis : {0, 1}) { // lengthwise, z is the plane's second or first coordinate
    const std::size_t along = axis == 0 ? 1 : 0;
    std::size_t wall = 0;
    for (const auto& [from, to] : section_outline(bodies[0], {axis, 0.0})) {
      const double a = std::abs(from[1 - along]), b = std::abs(to[1 - along]);
      CHECK((a >= 2 - 1e-12 && b >= 2 - 1e-12));
      if (std::abs(a - 2) < 1e-12 && std::abs(b - 2) < 1e-12 && std::abs(to[along] - from[along]) > 1) {
        ++wall;
        // Between the round edges of 0.1 at -1.5 and 1.8.
        CHECK(std::abs(std::min(from[along], to[along]) + 1.4) < 1e-12);
        CHECK(std::abs(std::max(from[along], to[along]) - 1.7) < 1e-12);
      }
    }
    CHECK(wall == 2);
  }
}

TEST_CASE("a section beside a rod's axis is as wide as the chord there") {
  ToolGeometry rod;
  rod.name = "roller";
  rod.shape = ToolKind::cylinder;
  rod.direction = {1, 0, 0};
  rod.point = {0, 0, 2};
  rod.radius = 0.8;
  rod.half_length = 1;
  const std::vector<ToolBody> bodies = bodies_of(with_tool(rod));
  REQUIRE(bodies.size() == 1);
  for (const double y : {0.0, 0.3, -0.7}) {
    const double chord = 2 * std::sqrt(0.64 - y * y);
    CHECK(std::abs(area_within(section_outline(bodies[0], {1, y})) - 2 * chord) < 1e-9);
  }
  CHECK(section_outline(bodies[0], {1, 0.81}).empty());
  // 360 chords instead of the circle: (2 pi / 360)^2 / 6 less; the midpoint rule's own error is of the same order.
  CHECK(area_within(section_outline(bodies[0], {0, 0.5})) == Approx(M_PI * 0.64).epsilon(2e-4));
}

TEST_CASE("spheres, cones and slabs are cut in the areas known for them") {
  ToolGeometry tool;
  tool.name = "tool";
  tool.shape = ToolKind::sphere;
  tool.radius = 1;
  tool.point = {0, 0, 1};
  std::vector<ToolBody> bodies = bodies_of(with_tool(tool));
  // 60 chords over half a turn: the profile lies up to (pi / 60)^2 / 8 = 3e-4 of the radius inside.
  for (int axis = 0; axis < 3; ++axis)
    CHECK(area_within(section_outline(bodies.at(0), {axis, axis == 2 ? 1.4 : 0.4})) ==
          Approx(M_PI * 0.84).epsilon(2e-3));
  tool.shape = ToolKind::cone;
  tool.direction = {0, 0, 1};
  tool.half_angle = M_PI / 4;
  tool.point = {0, 0, 0};
  bodies = bodies_of(with_tool(tool));
  CHECK(area_within(section_outline(bodies.at(0), {2, 0.5})) == Approx(M_PI * 0.25).epsilon(2e-4));
  tool.shape = ToolKind::plane;
  tool.direction = {0.6, 0, 0.8};
  const Snapshot snapshot = with_tool(tool);
  const DrawnExtent extent = drawn_extent(snapshot);
  bodies = bodies_of(snapshot);
  // The plane passes through the middle of a cube of 2 a: its trace across y is 2 a / 0.8 long, and the slab is flat.
  const double a = extent.high[0];
  CHECK(std::abs(area_within(section_outline(bodies.at(0), {1, 0.1})) - 2 * a / 0.8 * extent.thickness) < 1e-6);
}

TEST_CASE("the bodies of a die and its punches have the volumes of their shapes, and closed surfaces") {
  const Snapshot snapshot = snapshot_of(die_run());
  const DrawnExtent extent = drawn_extent(snapshot);
  const std::vector<ToolBody> bodies = tool_bodies(snapshot, extent);
  const Snapshot tets = tool_tets(bodies);
  // The punches end where the extent does. Places are single precision numbers: 1e-6 of some mm.
  CHECK(volume_of(tets, 1) == Approx(share_of_circle * M_PI * 4 * (-1.4 - extent.low[2])).epsilon(1e-5));
  CHECK(volume_of(tets, 2) == Approx(share_of_circle * M_PI * 4 * (extent.high[2] - 1.5)).epsilon(1e-5));
  // The sleeve less the two round edges, by Pappus: r^2 (1 - pi/4) less each, within the chords of the edge.
  const double back = 2 + extent.thickness;
  CHECK(volume_of(tets, 0) ==
        Approx(share_of_circle * M_PI * ((back * back - 4) * 3.3 - 2 * 2 * 2 * 0.0022)).epsilon(1e-3));
  double six = 0;
  for (const SolidTriangle& t : tool_surface(bodies, extent, {}))
    six += t.corner[0].position.dot(t.corner[1].position.cross(t.corner[2].position));
  CHECK(six / 6 == Approx(volume_of(tets, 0) + volume_of(tets, 1) + volume_of(tets, 2)).epsilon(1e-5));
}

TEST_CASE("a plate without a die is a slab that ends with the scene, and a body of triangles stays what it is") {
  ToolGeometry plate;
  plate.name = "plate";
  plate.point = {1.5, 0, 0};
  plate.direction = {-1, 0, 0};
  Snapshot snapshot = with_tool(plate);
  DrawnExtent extent = drawn_extent(snapshot);
  auto [low, high] = bounds_of(tool_surface(tool_bodies(snapshot, extent), extent, {}));
  CHECK((low - Eigen::Vector3d(1.5, extent.low[1], extent.low[2])).norm() < 1e-6);
  CHECK((high - Eigen::Vector3d(1.5 + extent.thickness, extent.high[1], extent.high[2])).norm() < 1e-6);
  ToolGeometry body;
  body.name = "wedge";
  body.shape = ToolKind::triangles;
  body.vertex = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  body.triangle = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  snapshot = with_tool(body);
  extent = drawn_extent(snapshot);
  std::tie(low, high) = bounds_of(tool_surface(tool_bodies(snapshot, extent), extent, {}));
  CHECK(low.norm() < 1e-12);
  CHECK((high - Eigen::Vector3d::Ones()).norm() < 1e-12);
  CHECK(std::abs(area_within(section_outline(bodies_of(snapshot).at(0), {2, 0.4})) - 0.5 * 0.36) < 1e-9);
}

TEST_CASE("a scene has its tools behind its grains, cut open, and none where they are not wanted") {
  const Snapshot snapshot = snapshot_of(die_run());
  SceneRequest request;
  const PictureScene with = make_scene(snapshot, request);
  request.tools = false;
  const PictureScene without = make_scene(snapshot, request), plain = make_scene(snapshot_of(small_run()), request);
  REQUIRE(with.triangles.size() > without.triangles.size());
  CHECK(with.triangles.size() == with.colours.size());
  CHECK(without.triangles.size() == plain.triangles.size());
  const CutAway away = tool_cut_away(snapshot, SceneRequest{});
  bool cut_face = false;
  for (std::size_t t = without.triangles.size(); t < with.triangles.size(); ++t) {
    const SolidTriangle& triangle = with.triangles[t];
    CHECK(triangle.grain >= 2); // grains are 0 and 1
    cut_face = cut_face || triangle.face > 0;
    const Eigen::Vector3d middle =
        (triangle.corner[0].position + triangle.corner[1].position + triangle.corner[2].position) / 3;
    CHECK_FALSE(std::all_of(away.begin(), away.end(),
                            [&](const HalfSpace& h) { return h.normal.dot(middle) < h.offset - 1e-9; }));
  }
  CHECK(cut_face);
  CHECK(with.bar->range == without.bar->range);
}

TEST_CASE("a raster fills tools with grey beside the grains, with a rim") {
  const Snapshot snapshot = snapshot_of(die_run());
  Lines lines;
  for (const ToolBody& body : bodies_of(snapshot)) lines.tools.push_back(section_outline(body, {1, 0.1}));
  const auto polygons = cut(snapshot, {1, 0.1});
  const std::vector<Colour> red(snapshot.tets(), Colour{200, 0, 0});
  // Across y the plane's coordinates are z and x. 100 pixels a mm.
  const View view{{-2.5, -2.5}, {2.5, 2.5}};
  const Raster raster = draw_section(polygons, red, snapshot.tet_grain, view, 500, lines);
  const auto at = [&](double z, double x) {
    return raster.pixel[static_cast<std::size_t>(std::lround((2.5 - x) * 100)) * 500 +
                        static_cast<std::size_t>(std::lround((z + 2.5) * 100))];
  };
  constexpr Colour grey{205, 208, 212};
  CHECK(at(0.3, 0.3) == Colour{200, 0, 0});
  CHECK(at(1.3, 0.3) == Colour{255, 255, 255}); // between cube and punch
  CHECK(at(1.6, 0.3) == grey);
  CHECK(at(-1.6, -0.3) == grey);
  CHECK(at(0, 2.2) == grey);
  CHECK(at(0, -2.2) == grey);
  CHECK(at(0, 2.45) == Colour{255, 255, 255}); // outside of the sleeve
  CHECK(at(1.5, 0.3)[0] < 200);                // the punch's rim
}

TEST_CASE("a page has the surfaces of tools within their bounds, and nothing of them without tools") {
  const Snapshot snapshot = snapshot_of(die_run());
  const ViewData data = view_data({snapshot});
  const DrawnExtent extent = drawn_extent(snapshot);
  const auto triangles = tool_surface(tool_bodies(snapshot, extent), extent, {});
  REQUIRE(data.states[0].tool_position.size() == 9 * triangles.size());
  CHECK(data.states[0].tool_normal.size() == 9 * triangles.size());
  for (std::size_t k = 0; k < 3; ++k) {
    const double width = data.tool_high[k] - data.tool_low[k];
    const double x = data.tool_low[k] + width * data.states[0].tool_position[k] / 65535;
    CHECK(std::abs(x - triangles[0].corner[0].position[static_cast<int>(k)]) <= 0.51 * width / 65535);
  }
  CHECK(view_data({snapshot_of(small_run())}).states[0].tool_position.empty());
}

TEST_CASE("a run with tools has their surfaces as VTK files beside those of the grains, others have none") {
  const Folder folder;
  write_run(folder / "die.h5", die_run());
  write_run(folder / "plain.h5", small_run());
  write_run_as_vtk({folder / "die.h5", schema::FileKind::run}, folder / "die", true);
  const auto plain = write_run_as_vtk({folder / "plain.h5", schema::FileKind::run}, folder / "plain", true);
  CHECK(plain.size() == 6); // snapshot, grains and contacts, and a list over time of each
  CHECK(read_text(folder / "die/run.pvd") == read_text(folder / "plain/run.pvd"));
  CHECK(read_text(folder / "die/0000.vtu") == read_text(folder / "plain/0000.vtu"));
  CHECK_THAT(read_text(folder / "die/tools.pvd"),
             Catch::Contains("timestep=\"2e-06\" part=\"0\" file=\"0000-tools.vtp\""));
  CHECK_THAT(read_text(folder / "die/0000-tools.vtp"), Catch::Contains("0 die, 1 lower, 2 plate, 3 upper"));

  // Two hyphens in a name must not end the comment that lists the names.
  RunContents hyphens = die_run();
  add_tool(hyphens, {"z---plate", "plane", {{"point", {0, 1.5, 0}}, {"direction", {0, -1, 0}}}});
  write_run(folder / "hyphens.h5", hyphens);
  write_run_as_vtk({folder / "hyphens.h5", schema::FileKind::run}, folder / "hyphens", true);
  CHECK_THAT(read_text(folder / "hyphens/0000-tools.vtp"), Catch::Contains("3 upper, 4 z- - -plate -->"));
}
