// Normals and tributary areas of surface nodes.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/kernels/surface.hpp"
#include "solver/model/normals.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("normals computed in packs equal those computed singly, and the bounds equal those of the surface nodes") {
  GrainMesh first = ball_mesh(4, 0.2), second = cube_mesh(3);
  rotate(first, {0.6, 0.8, 0}, 0.3);
  scale(second, 0.15);
  move(first, {0.3, 0.5, 0.5});
  move(second, {0.75, 0.5, 0.5});
  Model model = build_model(pack({first, second}, {1, 1, 1}), holding_scenario(1e-9), "test");
  for (int grain = 0; grain < 2; ++grain) set_normals(model, grain);
  const auto plain = model.normal;
  std::fill(model.normal.begin(), model.normal.end(), 0.0);
  for (int grain = 0; grain < 2; ++grain) {
    const Bounds bounds = update_surface(model, grain);
    const auto begin = static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(grain)]);
    const auto count = static_cast<std::size_t>(model.surface_node_count[static_cast<std::size_t>(grain)]);
    for (std::size_t n = begin; n < begin + count; ++n)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(model.normal[4 * n + axis] - plain[4 * n + axis]) < rounding);
        CHECK(model.position[4 * n + axis] >= bounds.low[axis]);
        CHECK(model.position[4 * n + axis] <= bounds.high[axis]);
      }
  }
  for (std::size_t n = 0; n < plain.size() / 4; ++n) CHECK(within(model.normal[4 * n + 3], plain[4 * n + 3], rounding));
}

TEST_CASE("the normals of a ball's mesh point outwards, and its tributary areas add up to less than the sphere's") {
  constexpr double radius = 0.2;
  GrainMesh ball = ball_mesh(6, radius);
  move(ball, {0.5, 0.5, 0.5});
  Model model = build_model(pack({ball}, {1, 1, 1}), holding_scenario(1e-9), "test");
  update_surface(model, 0);
  double area = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.surface_node_count[0]); ++n) {
    double outwards = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      outwards += model.normal[4 * n + axis] * (model.position[4 * n + axis] - 0.5) / radius;
    CHECK(outwards > 0.99); // the mesh is not the same all around a node
    area += model.normal[4 * n + 3];
  }
  const double sphere = 4 * std::numbers::pi * radius * radius;
  CHECK(area < sphere);
  CHECK(area > 0.95 * sphere); // facets of a sixth of a right angle, and their vectors do not all point alike
}
