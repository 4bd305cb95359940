// Surfaces of tools: distances against closed forms, normals against gradients, and bounds that never hide a touch.

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "solver/boundary/tools.hpp"
#include "solver/run/make_tools.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

using Point = std::array<double, 3>;
constexpr double endless = std::numeric_limits<double>::infinity();

template <class Surface>
double distance(const Surface& surface, const Point& x) {
  return surface.gap([&](std::size_t axis) { return x[axis]; }).distance;
}

template <class Surface>
Point normal(const Surface& surface, const Point& x) {
  const Vector3<double> n = surface.gap([&](std::size_t axis) { return x[axis]; }).normal.vector();
  return {n.x, n.y, n.z};
}

const CylinderSurface die{2, {0.5, 0.5, 0.5}, 0.4, true, 0.6, 0.1};
const CylinderSurface rod{0, {0.5, 0.5, 0.5}, 0.3, false, 0.5, 0.0};

/// Holds the normal to the gradient of the distance, and both to unit length, at random places.
template <class Surface>
void check_gradient(const Surface& surface) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5);
  int edges = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point x{coordinate(random), coordinate(random), coordinate(random)}, n = normal(surface, x);
    constexpr double shift = 1e-6;
    double worst = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Point above = x, below = x;
      above[axis] += shift, below[axis] -= shift;
      worst = std::max(worst, std::abs((distance(surface, above) - distance(surface, below)) / (2 * shift) - n[axis]));
    }
    // Where the nearest point jumps, inside the matter and on axes, there is no gradient.
    if (worst > 1e-4) ++edges;
    CHECK(within(std::hypot(n[0], n[1], n[2]), 1, 1e-12));
  }
  CHECK(edges <= 2);
}

/// Wherever a point of a block is behind a surface, the block may touch it.
template <class Surface>
void check_bounds(const Surface& surface) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5), size(0, 0.4), part(0, 1);
  int behind = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    Bounds bounds{};
    Point x{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = coordinate(random);
      bounds.high[axis] = bounds.low[axis] + size(random);
      x[axis] = bounds.low[axis] + part(random) * (bounds.high[axis] - bounds.low[axis]);
    }
    const bool touches = distance(surface, x) < 0;
    behind += touches ? 1 : 0;
    refused += surface.may_touch(bounds) ? 0 : 1;
    if (touches) CHECK(surface.may_touch(bounds));
  }
  CHECK(behind > 100);
  CHECK(refused > 30); // a sphere that holds grains inside refuses few of these
}

} // namespace

TEST_CASE("the distance to a die is that to its bore, its end faces or its rounded mouth") {
  CHECK(within(distance(die, {0.5, 0.8, 0.5}), 0.1, 1e-14));    // in the bore
  CHECK(within(distance(die, {0.95, 0.5, 0.3}), -0.05, 1e-14)); // behind it
  CHECK(within(distance(die, {1.4, 0.5, 1.3}), 0.2, 1e-14));    // above the upper face, at z = 1.1
  // The mouth's circle has its centre at radius 0.5, z = 1; its surface lies 0.1 from there.
  CHECK(within(distance(die, {0.95, 0.5, 1.15}), std::hypot(0.05, 0.15) - 0.1, 1e-14));
  CHECK(within(distance(die, {0.5, 0.5 + 0.5 - 0.1 / std::sqrt(2), 1 + 0.1 / std::sqrt(2)}) + 1, 1, 1e-14));
  const Point n = normal(die, {0.95, 0.5, 1.15});
  CHECK(within(n[0], -0.05 / std::hypot(0.05, 0.15), 1e-14));
  CHECK(within(n[2], 0.15 / std::hypot(0.05, 0.15), 1e-14));
}

TEST_CASE("a rod pushes outwards and ends where its extent ends") {
  CHECK(within(distance(rod, {0.5, 0.5, 0.9}), 0.1, 1e-14));
  CHECK(within(distance(rod, {0.5, 0.5, 0.7}), -0.1, 1e-14));
  CHECK(within(distance(rod, {1.2, 0.5, 0.7}), 0.2, 1e-14)); // beyond the end at x = 1
  CHECK(within(normal(rod, {1.2, 0.5, 0.7})[0], 1, 1e-14));
}

TEST_CASE("distances to spheres and cones are those of their closed forms") {
  CHECK(within(distance(SphereSurface{{0, 0, 0}, 2, false}, {3, 0, 4}), 3, 1e-14));
  CHECK(within(distance(SphereSurface{{0, 0, 0}, 6, true}, {3, 0, 4}), 1, 1e-14));
  // Half an angle of 45 degrees: a point on the axis is s/sqrt(2) from the side.
  const double half = 1 / std::sqrt(2);
  const ConeSurface hopper{2, 1, {0, 0, 1}, half, half, true};
  CHECK(within(distance(hopper, {0, 0, 3}), 2 * half, 1e-14));
  CHECK(within(distance(hopper, {3, 0, 3}), -half, 1e-14));
  const ConeSurface indenter{2, -1, {0, 0, 1}, half, half, false};
  CHECK(within(distance(indenter, {0, 0, -1}), -2 * half, 1e-14));
  CHECK(within(distance(indenter, {3, 0, -1}), half, 1e-14));
}

TEST_CASE("the normal of every tool's surface is the gradient of its distance") {
  check_gradient(OrientedPlane{{0.2, 0.5, 0.1}, {0.6, 0, 0.8}});
  check_gradient(die);
  check_gradient(rod);
  check_gradient(CylinderSurface{1, {0.5, 0.5, 0.5}, 0.4, true, endless, 0});
  check_gradient(SphereSurface{{0.5, 0.4, 0.6}, 0.5, true});
  check_gradient(SphereSurface{{0.5, 0.4, 0.6}, 0.5, false});
  check_gradient(ConeSurface{2, 1, {0.5, 0.5, 0.1}, 0.6, 0.8, true});
  check_gradient(ConeSurface{0, -1, {0.5, 0.5, 0.9}, 0.8, 0.6, false});
}

TEST_CASE("bounds never hide a point that is behind a tool") {
  check_bounds(OrientedPlane{{0.2, 0.5, 0.1}, {0.6, 0, 0.8}});
  check_bounds(die);
  check_bounds(rod);
  check_bounds(SphereSurface{{0.5, 0.4, 0.6}, 0.5, true});
  check_bounds(SphereSurface{{0.5, 0.4, 0.6}, 0.5, false});
  check_bounds(ConeSurface{2, 1, {0.5, 0.5, 0.1}, 0.6, 0.8, true});
}

TEST_CASE("the distance of a tool to a point that moves with it does not change") {
  const Vector3<double> by{0.1, -0.2, 0.3};
  const Shifted<CylinderSurface> moved{die, by};
  for (const Point& x : {Point{0.5, 0.8, 0.5}, Point{0.95, 0.5, 1.15}, Point{1.4, 0.5, 1.3}})
    CHECK(within(distance(moved, {x[0] + by.x, x[1] + by.y, x[2] + by.z}), distance(die, x), 1e-13));
}

TEST_CASE("planes at faces and cylinders without numbers take their place from the packing's box") {
  const std::array<double, 3> low{0, 0, 0}, high{2, 3, 4};
  PlaneShape top;
  top.face = 5;
  top.normal = {0, 0, -1};
  const auto plane = std::get<OrientedPlane>(make_surface(top, low, high));
  CHECK(plane.point.z == 4);
  CHECK(plane.normal.z == -1);
  const auto bore = std::get<CylinderSurface>(make_surface(CylinderShape{}, low, high));
  CHECK(bore.radius == 1); // half of the narrower width
  CHECK(bore.centre.y == 1.5);
  CHECK(bore.half_length == endless);
}
