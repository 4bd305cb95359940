// Signed distance to a closed surface of triangles.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "surfaces/stl.hpp"
#include "surfaces/triangulated_surface.hpp"
#include "tests/common/one_line_error.hpp"
#include "tests/support/tolerances.hpp"
#include "tests/support/triangle_meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

using Array = std::array<double, 3>;
using Polygon = std::vector<std::array<double, 2>>;

/// Lengths of bodies are about 1 mm: a closed form in doubles is met to a thousand roundings.
constexpr double closed_form = 1e-12;

/// Random points in and around a box.
class RandomPoints {
public:
  RandomPoints(std::uint32_t seed, const Bounds& bounds, double around)
      : random_(seed), bounds_(bounds), around_(around) {}
  Array next() {
    Array x{};
    for (std::size_t a = 0; a < 3; ++a)
      x[a] = std::uniform_real_distribution(bounds_.low[a] - around_, bounds_.high[a] + around_)(random_);
    return x;
  }
  Array direction() {
    std::normal_distribution<double> normal;
    const Array v{normal(random_), normal(random_), normal(random_)};
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
  }

private:
  std::mt19937 random_;
  Bounds bounds_;
  double around_;
};

double segment_distance(const std::array<double, 2>& a, const std::array<double, 2>& b, double x, double y) {
  const double ex = b[0] - a[0], ey = b[1] - a[1];
  const double t = std::clamp(((x - a[0]) * ex + (y - a[1]) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
  return std::hypot(x - a[0] - t * ex, y - a[1] - t * ey);
}

/// In the plane; negative inside.
double polygon_distance(const Polygon& polygon, double x, double y) {
  double distance = std::numeric_limits<double>::max();
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    distance = std::min(distance, segment_distance(a, b, x, y));
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside ? -distance : distance;
}

/// Closed form of the signed distance to a prism over a polygon.
double prism_distance(const Polygon& polygon, double low, double high, const Array& x) {
  const double across = polygon_distance(polygon, x[0], x[1]), along = std::max(low - x[2], x[2] - high);
  return across > 0 && along > 0 ? std::hypot(across, along) : std::max(across, along);
}

/// Closed form for the unit cube.
double cube_distance(const Array& x) {
  const Array q{std::abs(x[0] - 0.5) - 0.5, std::abs(x[1] - 0.5) - 0.5, std::abs(x[2] - 0.5) - 0.5};
  const double outside = std::hypot(std::max(q[0], 0.0), std::max(q[1], 0.0), std::max(q[2], 0.0));
  return outside > 0 ? outside : std::max({q[0], q[1], q[2]});
}

/// No tree, no blocks, no seed.
double brute_force_distance(const TriangleMesh& mesh, const Array& x) {
  Nearest nearest{std::numeric_limits<double>::infinity(), 0, Feature::face, {}};
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
    flat_triangle({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)})
        .offer({x[0], x[1], x[2]}, static_cast<std::int32_t>(t), 0, nearest);
  return std::sqrt(nearest.squared);
}

double winding_number(const TriangleMesh& mesh, const Array& x) {
  double winding = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) winding += winding_share(mesh, t, {x[0], x[1], x[2]});
  return winding;
}

double difference(double a, double b) {
  return std::abs(a - b);
}

/// Holds the side of random points to the winding number, and the distance to all triangles one by one.
void check_against_brute_force(const TriangleMesh& mesh, int points, std::uint32_t seed) {
  const TriangulatedSurface surface(mesh);
  RandomPoints random(seed, surface.bounds(), 0.3);
  int inside = 0, wrong_side = 0;
  double largest = 0;
  for (int i = 0; i < points; ++i) {
    const Array x = random.next();
    const double distance = surface.gap(x).distance;
    const bool is_inside = winding_number(mesh, x) > 0.5;
    inside += is_inside ? 1 : 0;
    wrong_side += is_inside != (distance < 0) ? 1 : 0;
    largest = std::max(largest, difference(std::abs(distance), brute_force_distance(mesh, x)));
  }
  CHECK(inside > points / 50);
  CHECK(inside < points);
  CHECK(wrong_side == 0);
  CHECK(largest < closed_form);
}

} // namespace

TEST_CASE("the distance to a cube is that of its closed form, inside and outside") {
  const TriangulatedSurface cube(welded(unit_cube()));
  RandomPoints random(1, cube.bounds(), 1);
  for (int i = 0; i < 5000; ++i) {
    const Array x = random.next();
    CHECK(difference(cube.gap(x).distance, cube_distance(x)) < closed_form);
  }
}

TEST_CASE("the normal of a flat face is exact, also next to the surface and where triangles meet in it") {
  const TriangulatedSurface cube(welded(unit_cube()));
  for (const double height : {-0.1, -1e-9, 0.0, 1e-15, 1e-6, 0.3})
    for (const Array& x : {Array{0.3, 0.6, 1 + height}, Array{0.5, 0.5, 1 + height}, Array{0.25, 0.25, 1 + height}}) {
      const SurfaceGap gap = cube.gap(x);
      CHECK(difference(gap.distance, height) < 1e-15);
      CHECK(gap.normal == Array{0, 0, 1});
    }
}

TEST_CASE("in front of an edge or a corner the normal points to the point, closely in front it is the pseudonormal") {
  const TriangulatedSurface cube(welded(unit_cube()));
  const double s2 = std::sqrt(0.5), s3 = std::sqrt(1.0 / 3);
  for (const double way : {1e-11, 0.2}) { // over 1e-11 a direction from coordinates of 1 has five digits
    const SurfaceGap edge = cube.gap({1 + s2 * way, 0.5, 1 + s2 * way});
    CHECK(difference(edge.distance, way) < closed_form);
    CHECK(difference(edge.normal[0], s2) < closed_form);
    CHECK(difference(edge.normal[1], 0) < closed_form);
    const SurfaceGap corner = cube.gap({-s3 * way, -s3 * way, -s3 * way});
    CHECK(difference(corner.distance, way) < closed_form);
    for (const double n : corner.normal) CHECK(difference(n, -s3) < closed_form);
  }
  CHECK(cube.gap({1, 0.5, 1}).distance == 0);
  CHECK(cube.gap({0, 0, 0}).distance == 0);
}

TEST_CASE("the distance to an L is that of its closed form, also at the concave edge") {
  const TriangulatedSurface part(welded(prism(l_shape, -1, 0.5)));
  RandomPoints random(2, part.bounds(), 1);
  for (int i = 0; i < 5000; ++i) {
    const Array x = random.next();
    CHECK(difference(part.gap(x).distance, prism_distance(l_shape, -1, 0.5, x)) < closed_form);
  }
  CHECK(difference(part.gap({1.2, 1.1, 0}).distance, 0.1) < closed_form);
  CHECK(difference(part.gap({0.9, 0.8, 0}).distance, -std::hypot(0.1, 0.2)) < closed_form);
}

TEST_CASE("the distance to a cylinder of flat faces is that of its polygon, and near that of the round one") {
  const Polygon polygon = regular_polygon(200, 1);
  const TriangulatedSurface cylinder(welded(prism(polygon, 0, 5)));
  RandomPoints random(3, cylinder.bounds(), 0.5);
  const double sagitta = 1 - std::cos(M_PI / 200);
  for (int i = 0; i < 2000; ++i) {
    const Array x = random.next();
    const double distance = cylinder.gap(x).distance;
    CHECK(difference(distance, prism_distance(polygon, 0, 5, x)) < closed_form);
    if (x[2] > 1 && x[2] < 4) CHECK(difference(distance, std::hypot(x[0], x[1]) - 1) < sagitta + closed_form);
  }
}

TEST_CASE("triangles a hundred thousand times longer than wide give the distance of the body that they make up") {
  // The first corner sees all others, so that no triangle of the caps has its corners on one line.
  const Polygon polygon{{0, 1}, {0, 0}, {1e-5, 0}, {2e-5, 0}, {4e-5, 0}, {1, 0}, {1, 1}};
  const TriangulatedSurface cube(weld_corners(prism(polygon, 0, 1), 2e-6));
  RandomPoints random(4, cube.bounds(), 0.5);
  for (int i = 0; i < 5000; ++i) {
    Array x = random.next();
    if (i % 2 == 0) x[0] = 1e-4 * x[0], x[1] = 1e-4 * x[1];
    CHECK(difference(cube.gap(x).distance, cube_distance(x)) < closed_form);
  }
}

TEST_CASE("the side of a point agrees with the winding number, and its distance with a search of all triangles") {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U})
    check_against_brute_force(welded(spiky_ball(7, 11, seed)), 4000, seed);
  check_against_brute_force(welded(spiky_ball(20, 30, 5)), 2000, 5);
  check_against_brute_force(welded(ball(12, 20, 1)), 1000, 6);
}

TEST_CASE("the side is right where bodies touch at a corner, and in a cavity") {
  check_against_brute_force(welded(together(unit_cube(), moved(unit_cube(), {1, 1, 1}))), 3000, 7);
  LooseTriangles cavity = inside_out(spiky_ball(7, 11, 8));
  for (auto& triangle : cavity)
    for (Point& x : triangle) x = 0.3 * x + Point{0.5, 0.5, 0.5};
  check_against_brute_force(welded(together(unit_cube(), cavity)), 3000, 9);
}

TEST_CASE("a body with a flipped sliver has the distance of the body without it") {
  LooseTriangles cube = unit_cube();
  const auto first = cube.front(); // a corner in the middle of its first edge, which the neighbour does not know
  const Point middle = 0.5 * (first[0] + first[1]);
  cube.front() = {first[0], middle, first[2]};
  cube.push_back({middle, first[1], first[2]});
  cube.push_back({first[0], first[1], middle});
  const StlBody body = stl_body(text_stl(cube), "test.stl", 1);
  REQUIRE(body.findings.flipped == 1);
  const TriangulatedSurface surface(body.mesh);
  RandomPoints random(10, surface.bounds(), 0.5);
  for (int i = 0; i < 2000; ++i) {
    const Array x = random.next();
    CHECK(difference(surface.gap(x).distance, cube_distance(x)) < closed_form);
  }
}

TEST_CASE("the gap is continuous: along random lines it changes by no more than the distance travelled") {
  const TriangulatedSurface surface(welded(spiky_ball(7, 11, 11)));
  RandomPoints random(12, surface.bounds(), 0.2);
  for (int line = 0; line < 200; ++line) {
    const Array start = random.next(), direction = random.direction();
    // Tiny steps around the zero of the gap, where it has one, and coarse steps along the line.
    constexpr double tiny = 1e-9;
    double before = surface.gap(start).distance;
    for (int step = 1; step <= 300; ++step) {
      const double s = step * 0.005;
      const auto at = [&](double way) {
        return surface.gap(
            {start[0] + way * direction[0], start[1] + way * direction[1], start[2] + way * direction[2]});
      };
      const double here = at(s).distance;
      REQUIRE(difference(here, before) < 0.005 + closed_form);
      REQUIRE(difference(at(s + tiny).distance, here) < tiny + closed_form);
      if (here * before < 0) { // it passes through zero, not over it
        double low = s - 0.005, high = s;
        while (high - low > 1e-12) (at(0.5 * (low + high)).distance * before > 0 ? low : high) = 0.5 * (low + high);
        REQUIRE(difference(at(low).distance, at(high).distance) < 1e-11);
      }
      before = here;
    }
  }
}

TEST_CASE("the normal is the gradient of the distance") {
  for (const GrainSide side : {GrainSide::outside, GrainSide::inside}) {
    const TriangulatedSurface surface(welded(spiky_ball(7, 11, 13)), side);
    RandomPoints random(14, surface.bounds(), 0.2);
    int kinks = 0;
    constexpr int points = 2000;
    for (int i = 0; i < points; ++i) {
      const Array x = random.next();
      const SurfaceGap gap = surface.gap(x);
      CHECK(within(std::hypot(gap.normal[0], gap.normal[1], gap.normal[2]), 1, closed_form));
      constexpr double shift = 1e-6; // rounding 1e-10 of the difference; curvature at corners (shift / distance)^2
      double error = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        Array above = x, below = x;
        above[a] += shift, below[a] -= shift;
        const double slope = (surface.gap(above).distance - surface.gap(below).distance) / (2 * shift);
        error = std::max(error, difference(slope, gap.normal[a]));
      }
      kinks += error > 1e-6 ? 1 : 0; // two places of the surface equally far
    }
    CHECK(kinks < points / 200);
  }
}

TEST_CASE("a container has the gap of its body with the other sign") {
  const TriangleMesh mesh = welded(prism(l_shape, 0, 1));
  const TriangulatedSurface body(mesh), container(mesh, GrainSide::inside);
  RandomPoints random(15, body.bounds(), 0.5);
  for (int i = 0; i < 1000; ++i) {
    const Array x = random.next();
    const SurfaceGap a = body.gap(x), b = container.gap(x);
    CHECK(a.distance == -b.distance);
    for (std::size_t k = 0; k < 3; ++k) CHECK(a.normal[k] == -b.normal[k]);
  }
}

TEST_CASE("with a reach the gap is the same up to it, and beyond it some number between the reach and the distance") {
  const TriangleMesh mesh = welded(spiky_ball(7, 11, 16));
  for (const GrainSide side : {GrainSide::outside, GrainSide::inside}) {
    const TriangulatedSurface surface(mesh, side);
    RandomPoints random(17, surface.bounds(), 3);
    for (int i = 0; i < 5000; ++i) {
      const Array x = random.next();
      const double distance = surface.gap(x).distance;
      for (const double reach : {0.0, 0.1, 1.0}) {
        const SurfaceGap gap = surface.gap(x, reach);
        if (distance <= reach) {
          REQUIRE(gap.distance == distance);
          REQUIRE(gap.normal == surface.gap(x).normal);
        } else {
          REQUIRE(gap.distance > reach);
          REQUIRE(gap.distance <= distance + closed_form);
        }
      }
    }
  }
}

TEST_CASE("a box touches where a point of it lies behind the surface, and not where it is clear of it") {
  const TriangulatedSurface body(welded(unit_cube())), container(welded(unit_cube()), GrainSide::inside);
  const Bounds across{{0.9, 0.4, 0.4}, {1.1, 0.6, 0.6}}, outside{{1.2, 0.4, 0.4}, {1.4, 0.6, 0.6}};
  const Bounds inside{{0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}};
  CHECK(body.may_touch(across));
  CHECK(container.may_touch(across));
  CHECK_FALSE(body.may_touch(outside));
  CHECK(container.may_touch(outside));
  CHECK(body.may_touch(inside));
  CHECK_FALSE(container.may_touch(inside));
}

TEST_CASE("a surface with a hole is refused, and a point that is no number has no gap") {
  LooseTriangles cube = unit_cube();
  cube.pop_back();
  CHECK(input_error([&] { TriangulatedSurface surface(welded(cube)); }).find("not closed") != std::string::npos);
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(TriangulatedSurface(welded(unit_cube())).gap({none, 0, 0}, 0).distance < 0);
}

TEST_CASE("a sphere's overlap with a surface is at least that of the closest place, and its normal is its gradient") {
  const TriangleMesh mesh = welded(spiky_ball(8, 12, 3));
  const TriangulatedSurface container(mesh, GrainSide::inside);
  RandomPoints points(5, container.bounds(), 0);
  const double radius = 0.25, step = 1e-6;
  int touching = 0;
  for (int n = 0; n < 4000; ++n) {
    const Array x = points.next(), way = points.direction();
    const auto at = [&](double s) {
      return container.gap_of_sphere({x[0] + s * way[0], x[1] + s * way[1], x[2] + s * way[2]}, radius);
    };
    const SurfaceGap gap = at(0), closest = container.gap(x);
    if (closest.distance < 2 * step) {
      CHECK(gap.distance == closest.distance); // the centre is outside
      continue;
    }
    CHECK(gap.distance <= closest.distance);
    if (closest.distance > radius - 2 * step) continue;
    ++touching;
    // The error of a central difference is the second derivative's change: some powers of step over the distance.
    const double slope = (at(step).distance - at(-step).distance) / (2 * step);
    const double along = gap.normal[0] * way[0] + gap.normal[1] * way[1] + gap.normal[2] * way[2];
    CHECK(std::abs(slope - along) < 20 * step / closest.distance);
  }
  CHECK(touching > 500);
}

TEST_CASE("a sphere that reaches one face only has the gap of that face") {
  const TriangulatedSurface cube(welded(unit_cube()), GrainSide::inside);
  const SurfaceGap gap = cube.gap_of_sphere({0.3, 0.6, 0.1}, 0.15); // the face's diagonal is 0.21 mm away
  CHECK(std::abs(gap.distance - 0.1) < closed_form);
  CHECK(std::abs(gap.normal[2] - 1) < closed_form);
  const SurfaceGap apart = cube.gap_of_sphere({0.3, 0.6, 0.3}, 0.15);
  CHECK(apart.distance >= 0.15);
}
