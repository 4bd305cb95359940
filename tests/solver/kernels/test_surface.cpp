// Normals, tributary areas and bounds of surface nodes.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/kernels/surface.hpp"
#include "solver/model/normals.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Rows of the unit normals and tributary areas of all surface nodes, from one facet after another.
std::vector<double> plain_normals(const Model& model) {
  const auto point = [&](std::int32_t node) { return model.point(static_cast<std::size_t>(node)); };
  std::vector<Vector3<double>> area(static_cast<std::size_t>(model.nodes()), {0, 0, 0});
  for (std::size_t f = 0; f < model.facet.size(); f += 3) {
    const std::int32_t* node = &model.facet[f];
    const Vector3<double> of_facet = cross(point(node[1]) - point(node[0]), point(node[2]) - point(node[0]));
    for (std::size_t c = 0; c < 3; ++c) {
      Vector3<double>& sum = area[static_cast<std::size_t>(node[c])];
      sum = sum + (1.0 / 6.0) * of_facet;
    }
  }
  std::vector<double> rows;
  for (const Vector3<double>& sum : area) {
    const double length = norm(sum), inverse = length > 0 ? 1 / length : 0.0;
    rows.insert(rows.end(), {inverse * sum.x, inverse * sum.y, inverse * sum.z, length});
  }
  return rows;
}

} // namespace

TEST_CASE("normals computed in packs equal those computed singly, and the bounds equal those of the surface nodes") {
  GrainMesh first = ball_mesh(4, 0.2), second = cube_mesh(3);
  rotate(first, {0.6, 0.8, 0}, 0.3);
  scale(second, 0.15);
  move(first, {0.3, 0.5, 0.5});
  move(second, {0.75, 0.5, 0.5});
  const Model model = build_model(pack({first, second}, {1, 1, 1}), holding_scenario(1e-9), "test");
  const std::vector<double> plain = plain_normals(model);
  for (int grain = 0; grain < 2; ++grain) {
    const Bounds bounds = surface_bounds(model, grain);
    const SurfaceNormals normals(model, grain);
    const auto begin = static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(grain)]);
    const auto count = static_cast<std::size_t>(model.surface_node_count[static_cast<std::size_t>(grain)]);
    for (std::size_t n = begin; n < begin + count; ++n) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(normals.normal(n)[axis] - plain[4 * n + axis]) < rounding);
        CHECK(model.position[4 * n + axis] >= bounds.low[axis]);
        CHECK(model.position[4 * n + axis] <= bounds.high[axis]);
      }
      CHECK(within(normals.area(n), plain[4 * n + 3], rounding));
    }
  }
}

TEST_CASE("the normals of a ball's mesh point outwards, and its tributary areas add up to less than the sphere's") {
  constexpr double radius = 0.2;
  GrainMesh ball = ball_mesh(6, radius);
  move(ball, {0.5, 0.5, 0.5});
  const Model model = build_model(pack({ball}, {1, 1, 1}), holding_scenario(1e-9), "test");
  const SurfaceNormals normals(model, 0);
  double area = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.surface_node_count[0]); ++n) {
    double outwards = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      outwards += normals.normal(n)[axis] * (model.position[4 * n + axis] - 0.5) / radius;
    CHECK(outwards > 0.99); // the mesh is not the same all around a node
    area += normals.area(n);
  }
  const double sphere = 4 * std::numbers::pi * radius * radius;
  CHECK(area < sphere);
  CHECK(area > 0.95 * sphere); // facets of a sixth of a right angle, and their vectors do not all point alike
}
