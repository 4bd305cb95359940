// What pictures in three dimensions show, without drawing: the cut solid, colours, frame.

#include <cmath>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "bonded_run.hpp"
#include "postproc/drawing/ticks.hpp"
#include "postproc/picture/heading.hpp"
#include "postproc/picture/view_frame.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// The cube [-1, 1]^3 of small_run, in a box of [-1.5, 1.5]^3.
Snapshot cube() {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  return read_snapshot({folder / "run.h5", schema::FileKind::run}, 0);
}

SceneRequest cut_of(const std::string& cut, double at) {
  SceneRequest request;
  request.cut = cut;
  request.cut_at = at;
  return request;
}

/// By the divergence theorem: of a closed surface whose triangles turn outward, whatever the origin.
double enclosed_volume(const std::vector<SolidTriangle>& triangles, const Eigen::Vector3d& origin) {
  double six_volumes = 0;
  for (const SolidTriangle& t : triangles)
    six_volumes +=
        (t.corner[0].position - origin).dot((t.corner[1].position - origin).cross(t.corner[2].position - origin));
  return six_volumes / 6;
}

std::vector<SolidTriangle> triangles_of(const Snapshot& snapshot, const SceneRequest& request) {
  return cut_solid(snapshot, shown_field(snapshot, "von_mises"), cut_away(snapshot, request));
}

} // namespace

TEST_CASE("what a cut leaves of a cube is closed and has the volume of the rest") {
  const Snapshot snapshot = cube();
  // The plane stands at -1.5 + 3 * 0.6 = 0.3 mm on each axis; the camera at x > 0, y < 0, z > 0.
  const struct {
    const char* cut;
    double volume; // mm^3, of 8
  } cases[] = {
      {"none", 8}, {"x", 2 * 2 * 1.3}, {"y", 2 * 2 * 0.7}, {"z", 2 * 2 * 1.3}, {"octant", 8 - 0.7 * 1.3 * 0.7}};
  for (const auto& c : cases) {
    INFO(c.cut);
    const auto triangles = triangles_of(snapshot, cut_of(c.cut, 0.6));
    // Positions come as single precision, but -1, 0 and 1 are exact in it; rounding of some hundred triangles remains.
    CHECK(std::abs(enclosed_volume(triangles, {0, 0, 0}) - c.volume) < 1e-12);
    CHECK(std::abs(enclosed_volume(triangles, {9, -7, 4}) - c.volume) < 1e-10); // closed: no matter from where
  }
}

TEST_CASE("a cut through nodes, and one beside the grains, leave closed solids too") {
  const Snapshot snapshot = cube();
  CHECK(std::abs(enclosed_volume(triangles_of(snapshot, cut_of("octant", 0.5)), {5, 5, 5}) - 7) < 1e-10);
  CHECK(std::abs(enclosed_volume(triangles_of(snapshot, cut_of("z", 1)), {5, 5, 5}) - 8) < 1e-10);
  CHECK(triangles_of(snapshot, cut_of("z", 0)).empty());
  CHECK_THROWS_WITH(make_scene(snapshot, cut_of("z", 0)),
                    Catch::Contains("--cut z: the cut at --cut-at 0 removes all grains"));
}

TEST_CASE("cut faces carry the field at the cut, and face what was cut away") {
  Snapshot snapshot = cube();
  // A field that is linear in z at the nodes must be so on a cut face as well: linear interpolation is exact.
  ShownField height = shown_field(snapshot, "von_mises");
  for (std::size_t n = 0; n < snapshot.nodes(); ++n) height.value[n] = static_cast<double>(snapshot.node[3 * n + 2]);
  std::size_t cut_faces = 0;
  for (const SolidTriangle& t : cut_solid(snapshot, height, cut_away(snapshot, cut_of("x", 0.6)))) {
    for (const SolidVertex& vertex : t.corner) CHECK(std::abs(vertex.value - vertex.position[2]) < 1e-12);
    if (t.face == 0) continue;
    ++cut_faces;
    for (const SolidVertex& vertex : t.corner) {
      CHECK(std::abs(vertex.position[0] - 0.3) < 1e-12);
      CHECK((vertex.normal - Eigen::Vector3d::UnitX()).norm() < 1e-12);
    }
  }
  CHECK(cut_faces > 0);
}

TEST_CASE("a constant field of tets is the same at the nodes, and edges of a cube stay sharp") {
  Snapshot snapshot = cube();
  for (Field& field : snapshot.tet_fields) std::fill(field.values.begin(), field.values.end(), 3.5F);
  for (const double value : shown_field(snapshot, "pressure").value) CHECK(std::abs(value - 3.5) < 1e-12);
  for (const SolidTriangle& t : triangles_of(snapshot, cut_of("none", 0.5)))
    for (const SolidVertex& vertex : t.corner)
      CHECK(std::abs(vertex.normal.cwiseAbs().maxCoeff() - 1) < 1e-12); // along an axis, never between two faces
}

TEST_CASE("colours and ticks: grey where there is no value, round numbers inside the range") {
  Snapshot snapshot = cube();
  snapshot.node_fields.push_back({"damage", "1", std::vector<float>(snapshot.nodes(), -1.0F)});
  SceneRequest request = cut_of("none", 0.5);
  request.colour = "damage";
  const PictureScene scene = make_scene(snapshot, request);
  REQUIRE(scene.bar);
  CHECK(scene.bar->range == std::pair<double, double>{0, 1});
  for (const CornerColours& colours : scene.colours)
    for (const Colour& colour : colours) CHECK((colour[0] == colour[1] && colour[1] == colour[2]));
  const auto near = [](const std::vector<double>& found, const std::vector<double>& expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 1e-9);
  };
  near(round_ticks({0, 1}, 6), {0, 0.2, 0.4, 0.6, 0.8, 1});
  near(round_ticks({0, 123.4}, 6), {0, 50, 100});
  near(round_ticks({-3, 9}, 6), {-2, 0, 2, 4, 6, 8});
  near(round_ticks({1.1, 1.9}, 1), {}); // 0 and 2 lie outside
  near(round_ticks({1.1, 1.9}, 2), {1.5});
  request.colour = "height";
  CHECK_THROWS_WITH(make_scene(snapshot, request), Catch::Contains("--color: found 'height', allowed: von-mises"));
}

TEST_CASE("damage is shown on whole grains, of which a cut takes away those with their centres in it") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const Snapshot snapshot = read_snapshot({folder / "run.h5", schema::FileKind::run}, 0);
  SceneRequest request = cut_of("none", 0.5);
  request.colour = "damage";
  CHECK(std::abs(enclosed_volume(make_scene(snapshot, request).triangles, {0, 0, 0}) - 24) < 1e-10);
  // Cubes of 8 mm^3 around (0, 0, 0), (2, 0, 0) and (0, 0, 2): a plane at x = 0.9 would cut all of them.
  request.cut = "x";
  request.cut_at = (0.9 - snapshot.box_low[0]) / (snapshot.box_high[0] - snapshot.box_low[0]);
  const PictureScene scene = make_scene(snapshot, request);
  CHECK(std::abs(enclosed_volume(scene.triangles, {0, 0, 0}) - 16) < 1e-10);
  for (const SolidTriangle& t : scene.triangles) CHECK((t.face == 0 && t.grain != 1));
}

TEST_CASE("all of the bounds lie in the picture for any direction of the camera") {
  const ShownBox bounds{{0, 0, 0}, {1, 2, 0.5}};
  const PictureSize size{800, 600};
  for (const double azimuth : {-180.0, -55.0, 0.0, 30.0, 90.0})
    for (const double elevation : {-90.0, -30.0, 0.0, 25.0, 90.0}) {
      const ViewFrame view = frame_view(bounds, {azimuth, elevation}, size, {.bar = true});
      CHECK(std::abs(view.right.cross(view.up).dot(view.towards_camera) - 1) < 1e-12); // right-handed
      for (int c = 0; c < 8; ++c) {
        const Eigen::Vector2d pixel = view.pixel_of({c & 1 ? 1.0 : 0.0, c & 2 ? 2.0 : 0.0, c & 4 ? 0.5 : 0.0});
        CHECK((pixel[0] > 0 && pixel[0] < 0.85 * size.width));  // the bar begins there
        CHECK((pixel[1] > 0 && pixel[1] < 0.91 * size.height)); // and the title there
      }
    }
}

TEST_CASE("a camera that rises to straight above does not turn the picture") {
  const ShownBox bounds{{0, 0, 0}, {1, 2, 0.5}};
  for (const double azimuth : {-55.0, 0.0, 120.0}) {
    const ViewFrame below = frame_view(bounds, {azimuth, 89.99}, {800, 600}, {}),
                    above = frame_view(bounds, {azimuth, 90.0}, {800, 600}, {});
    CHECK((below.right - above.right).norm() < 1e-3);
    CHECK((below.up - above.up).norm() < 1e-3);
  }
}

TEST_CASE("a title is broken between words, a word that is longer than a line is cut") {
  CHECK(text_lines("aa bb cc", 5) == std::vector<std::string>{"aa bb", "cc"});
  CHECK(text_lines("abcdefgh", 3) == std::vector<std::string>{"abc", "def", "gh"});
  PictureScene scene;
  scene.title = std::string(400, 'x');
  scene.note = "grains and bonds and contacts and grains and bonds and contacts and grains";
  const Heading heading = heading_of(scene, {400, 300});
  CHECK(heading.title.size() <= 3);
  for (const std::string& line : heading.title) CHECK(text_width(line, heading.title_height) < 400);
  for (const std::string& line : heading.note) CHECK(text_width(line, heading.note_height) < 400);
}

TEST_CASE("the ends of a colour scale say that values lie beyond them") {
  ColourBar bar{{0, 20}, "stress (MPa)"};
  for (const double value : {0.0, 12.0, 20.01}) bar.add(value);
  CHECK(bar.end_texts() == std::array<std::string, 2>{"", ""});
  bar.add(25);
  CHECK(bar.end_texts() == std::array<std::string, 2>{"", "≥ 20"});
  bar.add(-1);
  CHECK(bar.end_texts()[0] == "≤ 0");
}
