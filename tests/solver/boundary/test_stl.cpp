// STL files: what is read, repaired, counted and refused.

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "surfaces/stl.hpp"
#include "tests/common/one_line_error.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"
#include "tests/support/triangle_meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

StlBody body_of(const LooseTriangles& triangles) {
  return stl_body(text_stl(triangles), "test.stl", 1);
}

std::string refusal(const std::string& bytes) {
  return input_error([&] { stl_body(bytes, "test.stl", 1); });
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

/// The unit cube with a vertex in the middle of an edge that only one of its two faces knows; a triangle without area
/// fills in.
LooseTriangles cube_with_sliver() {
  LooseTriangles cube = unit_cube();
  const Point a{0, 0, 1}, b{1, 0, 1}, c{0.5, 0, 1};
  const auto same = [](const Point& p, const Point& q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  for (auto& triangle : cube)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!same(triangle[k], a) || !same(triangle[(k + 1) % 3], b)) continue;
      const Point opposite = triangle[(k + 2) % 3];
      triangle = {a, c, opposite};
      cube.push_back({c, b, opposite});
      cube.push_back({a, b, c}); // along a b as the triangle before, along b c and c a against the two new ones
      return cube;
    }
  return cube;
}

} // namespace

TEST_CASE("a body is the same from both forms of STL, and the scale multiplies its lengths") {
  const LooseTriangles part = prism(l_shape, -1, 2);
  const Folder folder;
  write_text(folder / "binary.stl", binary_stl(part));
  write_text(folder / "text.stl", text_stl(part));
  for (const auto& [name, scale] : {std::pair("binary.stl", 1.0), {"text.stl", 1.0}, {"binary.stl", 25.4}}) {
    const StlBody body = read_stl(folder / name, scale);
    CHECK(body.findings.binary == (std::string(name) == "binary.stl"));
    CHECK(body.findings.triangles == 20);
    CHECK(body.mesh.triangle.size() == 20);
    CHECK(body.findings.vertices == 12);
    CHECK(body.mesh.vertex.size() == 12);
    CHECK(body.findings.shells == 1);
    CHECK(within(body.findings.volume, 9 * scale * scale * scale, rounding));
    CHECK(within(body.findings.bounds.low[2], -scale, rounding));
    CHECK(within(body.findings.bounds.high[0], 2 * scale, rounding));
    CHECK(body.findings.dropped + body.findings.flipped + body.findings.other_normals == 0);
    CHECK_FALSE(body.findings.turned);
    CHECK(describe(body.findings).find("20 triangles, 12 vertices, 1 shell, ") == 0);
  }
}

TEST_CASE("a binary file whose text begins with solid is binary") {
  const StlBody body = stl_body(binary_stl(unit_cube(), "solid cube"), "test.stl", 1);
  CHECK(body.findings.binary);
  CHECK(body.findings.triangles == 12);
}

TEST_CASE("text with several solids, capital letters, other line ends and normals that are no numbers is read") {
  const std::string two = text_stl(unit_cube(), "") + text_stl(moved(unit_cube(), {2, 0, 0}), "second of two");
  std::string odd =
      replaced(replaced(replaced(two, "facet", "FACET"), "\n", "\r\n"), "normal 0 0 1", "normal nan -nan 1");
  const StlBody body = stl_body(odd, "test.stl", 1);
  CHECK(body.findings.triangles == 24);
  CHECK(body.findings.shells == 2);
  CHECK(within(body.findings.volume, 2, rounding));
  CHECK(body.findings.other_normals == 0);
}

TEST_CASE("corners that differ by the rounding of their numbers are one vertex") {
  LooseTriangles cube = moved(unit_cube(), {100, -30, 7});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-4e-7, 4e-7); // two corners differ by less than 1e-6 of sqrt(3)
  for (auto& triangle : cube)
    for (Point& x : triangle) x = x + Point{noise(random), noise(random), noise(random)};
  const StlBody body = body_of(cube);
  CHECK(body.findings.vertices == 8);
  CHECK(within(body.findings.volume, 1, 1e-5));
}

TEST_CASE("a triangle with two corners at one place is left out and leaves no hole") {
  LooseTriangles cube = unit_cube();
  const Point a{0, 0, 0}, b{1, 0, 0};
  cube.push_back({a, a + Point{1e-7, 0, 0}, b});
  const StlBody body = body_of(cube);
  CHECK(body.findings.dropped == 1);
  CHECK(body.findings.triangles == 12);
  CHECK(body.findings.vertices == 8);
}

TEST_CASE("an edge is flipped where a triangle has its corners on one line, and the body keeps its volume") {
  const LooseTriangles cube = cube_with_sliver();
  REQUIRE(cube.size() == 14);
  const StlBody body = body_of(cube);
  CHECK(body.findings.flipped == 1);
  CHECK(body.findings.triangles == 14);
  CHECK(within(body.findings.volume, 1, rounding));
  CHECK(pair_edges(body.mesh).closed());
  for (std::size_t t = 0; t < 14; ++t) CHECK(norm(area_vector(body.mesh, t)) > 0.1);
}

TEST_CASE("a surface that is inside out is turned round") {
  for (const bool turned : {false, true}) {
    const StlBody body = body_of(turned ? inside_out(prism(l_shape, 0, 1)) : prism(l_shape, 0, 1));
    CHECK(body.findings.turned == turned);
    CHECK(within(body.findings.volume, 3, rounding));
    double volume = 0;
    for (std::size_t t = 0; t < body.mesh.triangle.size(); ++t) volume += volume_share(body.mesh, t, {5, 5, 5});
    CHECK(within(volume, 3, rounding));
  }
}

TEST_CASE("bodies side by side, bodies that touch at a corner and cavities are counted as shells") {
  LooseTriangles small = unit_cube();
  for (auto& triangle : small)
    for (Point& x : triangle) x = 0.25 * x;
  const LooseTriangles hollow = together(unit_cube(), inside_out(moved(small, {0.5, 0.5, 0.5})));
  CHECK(body_of(hollow).findings.shells == 2);
  CHECK(within(body_of(hollow).findings.volume, 1 - 1.0 / 64, rounding));
  CHECK(within(body_of(inside_out(hollow)).findings.volume, 1 - 1.0 / 64, rounding));
  const StlBody touching = body_of(together(unit_cube(), moved(unit_cube(), {1, 1, 1})));
  CHECK(touching.findings.shells == 2);
  CHECK(touching.findings.vertices == 15);
}

TEST_CASE("stored normals are counted where they point away from the triangle's own, and change nothing") {
  const std::string text = text_stl(unit_cube());
  const StlBody body = stl_body(replaced(text, "normal 0 0 1", "normal 0 0 -1"), "test.stl", 1);
  CHECK(body.findings.other_normals == 2);
  CHECK(within(body.findings.volume, 1, rounding));
  CHECK(stl_body(replaced(text, "normal 0 0 1", "normal 0 0 0"), "test.stl", 1).findings.other_normals == 0);
}

TEST_CASE("what is not an STL file is refused with what was found and what is allowed") {
  const std::string binary = binary_stl(unit_cube()), text = text_stl(unit_cube());
  contains(refusal(binary.substr(0, binary.size() - 1)),
           "test.stl: is not an STL file: found 683 bytes, a binary one has 684");
  contains(refusal(""), "found 0 bytes");
  contains(refusal(std::string(1000, '\0')), "a binary one has 84 for the 0 triangles");
  contains(refusal("solid nothing\nendsolid\n"), "found no triangle");
  contains(refusal(binary_stl({})), "found no triangle");
  contains(refusal(text.substr(0, text.rfind("endsolid"))),
           "test.stl:86: found the end of the file, allowed: 'facet' or");
  contains(refusal(text + "more"), "test.stl:87: found 'more', allowed: 'solid'");
  contains(refusal(replaced(text, "vertex", "corner")), "test.stl:4: found 'corner', allowed: 'vertex'");
  contains(refusal(replaced(text, "1 1 1.0", "1 nan 1.0")), "found 'nan', allowed: a finite number");
  contains(refusal(replaced(text, "1 1 1.0", "1 1.0")), "found 'endloop', allowed: a finite number");
  LooseTriangles cube = unit_cube();
  cube[3][1].y = std::numeric_limits<double>::infinity();
  contains(refusal(binary_stl(cube)), "test.stl: triangle 4: found a corner at (");
  contains(input_error([] { read_stl("/nonexistent.stl", 1); }), "no such file");
}

TEST_CASE("lengths that are too large or too small are refused") {
  const std::string text = text_stl(unit_cube());
  contains(input_error([&] { stl_body(text, "test.stl", 1e10); }), "allowed: up to 1000000000 mm");
  contains(input_error([&] { stl_body(text, "test.stl", 1e-10); }), "allowed: at least 1e-09 mm");
  contains(input_error([&] { stl_body(text, "test.stl", 1e-10); }), "found a largest extent of");
}

TEST_CASE("a surface that is not closed and oriented is refused with the number of edges and one of them") {
  LooseTriangles cube = unit_cube();
  const auto last = cube.back();
  cube.pop_back();
  contains(refusal(text_stl(cube)), "found 3 edges that belong to one triangle only, one of triangle ");
  cube.push_back({last[0], last[2], last[1]});
  contains(refusal(text_stl(cube)),
           "found 3 edges that have two triangles that run along them the same way, one of triangle ");
  cube.back() = last;
  contains(refusal(text_stl(together(cube, moved(unit_cube(), {1, 1, 0})))),
           "found 1 edges that belong to more than two triangles, one of triangle ");
}

TEST_CASE("a faulty triangle has the number that it has in the file, also behind triangles that are left out") {
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1};
  const LooseTriangles open{{a, c, b}, {a, b, d}, {b, c, d}}; // without the face c a d
  contains(refusal(text_stl(open)), "one of triangle 1 from (0, 0, 0) mm to (0, 1, 0) mm");
  contains(refusal(text_stl(together({{a, a, b}, {b, c, b}}, open))), "one of triangle 3 from (0, 0, 0) mm to (0, 1");
  const LooseTriangles closed = together(open, {{c, a, d}});
  contains(refusal(text_stl(together(unit_cube(), inside_out(moved(closed, {3, 0, 0}))))),
           "the one of triangle 13 at (3, 0, 0)");
}

TEST_CASE("bodies without volume, shells inside out and bodies in bodies are refused") {
  const std::array<Point, 3> sheet{Point{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  contains(refusal(text_stl({sheet, {sheet[0], sheet[2], sheet[1]}})), "allowed: a body with a volume");
  const LooseTriangles large = prism({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, -3, 3);
  contains(refusal(text_stl(together(large, unit_cube()))), "lies in another one or runs through it");
  contains(refusal(text_stl(together(large, inside_out(moved(unit_cube(), {9, 0, 0}))))), "is turned inside out");
}

TEST_CASE("triangles without area that no flip mends are refused") {
  // Two that share two edges: a fold of no width on the edge of a tetrahedron.
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1}, m{0.5, 0, 0};
  const LooseTriangles tetrahedron{{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
  LooseTriangles folded = tetrahedron;
  folded.push_back({a, b, m});
  folded.push_back({b, a, m});
  contains(refusal(text_stl(folded)), "edges that belong to more than two triangles");
}

TEST_CASE("a flip that lays two triangles on two others is refused") {
  // A tetrahedron without height: its triangle a b m has no area, and the edge m d that a flip makes is there already.
  const Point a{0, 0, 0}, b{1, 0, 0}, d{0, 0, 1}, m{0.5, 0, 0};
  const LooseTriangles flat{{a, b, m}, {b, a, d}, {m, b, d}, {a, m, d}};
  contains(refusal(text_stl(together(unit_cube(), moved(flat, {3, 0, 0})))),
           "found 1 edges that belong to more than two triangles, one of triangle ");
}
