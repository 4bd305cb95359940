// On which side of a sharply folded surface a node is.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/kernels/contact_facet.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Solid angle (sr) of a facet as seen from a point, negative if it is seen from its outer side (Van Oosterom and
/// Strackee, IEEE Trans. Biomed. Eng. 30, 125, 1983).
double solid_angle(const Vector3<double>& from, const Vector3<double> (&x)[3]) {
  const Vector3<double> a = x[0] - from, b = x[1] - from, c = x[2] - from;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// True if a point is inside the closed surface of these facets: they surround it.
bool surrounded(const Model& model, const Vector3<double>& point, const std::vector<std::int32_t>& facets) {
  double angle = 0;
  for (const std::int32_t facet : facets) angle += solid_angle(point, facet_geometry(model, facet).x);
  return angle > 2 * std::numbers::pi;
}

/// A ball whose surface nodes are moved to random distances from its centre: spikes, valleys and saddles. As every ray
/// from the centre still meets the surface once, it does not cut itself.
Model spiky_ball(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.15, 1.0);
  GrainMesh ball = ball_mesh(3, 0.2);
  move(ball, {0.5, 0.5, 0.5});
  Model model = build_model(pack({ball}, {1, 1, 1}), holding_scenario(1e-9), "test");
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.surface_node_count[0]); ++n) {
    const double part = share(random);
    for (std::size_t axis = 0; axis < 3; ++axis)
      model.position[4 * n + axis] = 0.5 + part * (model.position[4 * n + axis] - 0.5);
  }
  return model;
}

/// A prism along y from -0.5 to 0.5 (mm) with a sharp edge on the y axis. Below it has a long face, z = 0, so that the
/// mean by area at the edge's ends looks down. Its short face rises from the edge by `slope` (rad).
GrainMesh blade(double slope) {
  GrainMesh mesh = block_mesh({1, 1, 1});
  for (auto& x : mesh.node) {
    const bool far = x[0] > 0, above = x[2] > 0;
    x[1] *= 0.5;
    x[0] = far ? 1.0 : above ? 0.3 * std::cos(slope) : 0.0;
    x[2] = !above ? 0.0 : far ? 0.3 : 0.3 * std::sin(slope);
  }
  return mesh;
}

/// A cube whose lowest corner is `corner` (mm) and whose opposite corner lies from there in the direction
/// (-sin slope, 0, cos slope). Half its edge is `half` (mm).
GrainMesh cube_on_its_corner(double half, double slope, const std::array<double, 3>& corner) {
  GrainMesh cube = cube_mesh(1);
  scale(cube, half);
  move(cube, {half, half, half});
  rotate(cube, {std::sqrt(0.5), -std::sqrt(0.5), 0}, std::acos(std::sqrt(1.0 / 3))); // the diagonal upright
  rotate(cube, {0, 1, 0}, -slope);
  move(cube, corner);
  return cube;
}

} // namespace

TEST_CASE("a node is outside a crumpled surface exactly where the surface does not surround it") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.3, 0.7);
  int on_folds = 0, against_own_facet = 0;
  for (int grain = 0; grain < 20; ++grain) {
    const Model model = spiky_ball(random);
    std::vector<std::int32_t> facets(model.facet.size() / 3);
    std::iota(facets.begin(), facets.end(), 0);
    for (int i = 0; i < 500; ++i) {
      const Vector3<double> node{place(random), place(random), place(random)};
      const Facet facet = facet_geometry(model, closest_facet(model, node, facets).facet);
      const ClosestPoint<double> closest = closest_point_on_triangle(node, facet.x);
      const Vector3<double> offset = node - closest.point;
      const bool outside = is_outside(model, offset, closest, facet, facets);
      REQUIRE(outside != surrounded(model, node, facets));
      if (closest.between == interior) continue;
      ++on_folds;
      against_own_facet += outside != (dot(offset, facet_direction(facet.x)) >= 0) ? 1 : 0;
    }
  }
  CHECK(on_folds > 5000);         // most closest points lie on edges and corners,
  CHECK(against_own_facet > 500); // and often the closest facet alone would give the wrong side
}

TEST_CASE("a facet's share at a corner is its angle there, on an edge it is 1, and without area there is none") {
  const Vector3<double> x[3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const double right = std::numbers::pi / 2;
  CHECK(within(share_of_direction(x, 0b001).z, right, rounding));
  CHECK(within(share_of_direction(x, 0b010).z, right / 2, rounding));
  CHECK(within(share_of_direction(x, 0b100).z, right / 2, rounding));
  for (const Corners edge : {0b011U, 0b101U, 0b110U}) CHECK(within(share_of_direction(x, edge).z, 1, rounding));
  const Vector3<double> needle[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  CHECK(norm(share_of_direction(needle, 0b001)) == 0);
  CHECK(norm(share_of_direction(needle, 0b011)) == 0);
}

TEST_CASE("a node that flies past a sharp edge without touching it is not pushed, and energy stays the same") {
  // The cube's lowest corner moves along the blade's short face, 0.03 mm above it, and on over the edge.
  const double slope = GENERATE(0.35, 0.7, 1.2), gap = 0.03, speed = 1e4;
  const std::array<double, 3> along = {std::cos(slope), 0, std::sin(slope)},
                              up = {-std::sin(slope), 0, std::cos(slope)}, middle = {0.5, 0.5, 0.5};
  GrainMesh cutting = blade(slope);
  std::array<double, 3> corner{};
  for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] = 0.2 * along[axis] + gap * up[axis] + middle[axis];
  move(cutting, middle);
  Scenario scenario = holding_scenario(0.3 / speed);
  scenario.contact.surface = ContactSurface::facets;
  scenario.grain_velocity = {{0, 0, 0}, {-speed * along[0], 0, -speed * along[2]}};
  const Model start = build_model(pack({cutting, cube_on_its_corner(0.1, slope, corner)}, {2, 2, 2}), scenario, "test");
  ThreadTeam team(1);
  Simulation simulation(start, scenario, team);
  const double initial = simulation.energies().initial;
  while (!simulation.stage_complete()) {
    simulation.evaluate_forces();
    const HistoryRow row = simulation.observe();
    REQUIRE(row.contact_energy == 0);
    REQUIRE(within(row.kinetic_energy, initial, accumulated_rounding));
    simulation.advance();
  }
  const Model& model = simulation.model();
  double lowest = 1; // of the cube: it has passed the edge, and is still as close to it as a candidate must be
  for (std::size_t n = model.first_node(1); n < model.end_node(1); ++n)
    lowest = std::min(lowest, dot(model.point(n) - Vector3<double>{0.5, 0.5, 0.5}, vector_of(up.data())));
  CHECK(within(lowest, gap, 1e-6));
  CHECK(model.point(model.first_node(1)).x < 0.5);
}
