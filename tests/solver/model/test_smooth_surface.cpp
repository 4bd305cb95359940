// Contact points behind the nodes of curved grains (solver/model/smooth_surface.hpp).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "solver/parallel/totals.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Model smooth_model(const MeshedPacking& packing) {
  Scenario scenario = holding_scenario(1e-9);
  scenario.contact.surface = ContactSurface::smooth;
  return build_model(packing, scenario, "test");
}

} // namespace

TEST_CASE("where a grain is flat its contact points are its nodes") {
  GrainMesh cube = cube_mesh(4);
  scale(cube, 0.1);
  move(cube, {0.5, 0.5, 0.5});
  const Model model = smooth_model(pack({cube}, {1, 1, 1}));
  int inside_faces = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.surface_node_count[0]); ++n) {
    int on_rim = 0; // away from edges by more than an element, whose normals are tilted
    for (std::size_t axis = 0; axis < 3; ++axis) on_rim += std::abs(model.position[4 * n + axis] - 0.5) > 0.04 ? 1 : 0;
    if (on_rim > 1) continue;
    ++inside_faces;
    CHECK(model.inward[n] < 1e-12);
  }
  CHECK(inside_faces == 6); // the middles
}

TEST_CASE("where a scenario does not say, meshes of spheres with their volume touch by smooth surfaces, and others by "
          "facets") {
  constexpr double radius = 0.1;
  GrainMesh exact = ball_mesh(6, radius), on_nodes = exact, cube = cube_mesh(4);
  GrainMesh alone = exact;
  move(alone, {0.5, 0.5, 0.5});
  const Model measured = build_model(pack({alone}, {1, 1, 1}), holding_scenario(1e-9), "test");
  CHECK(measured.smooth_grains == 0); // no radius is known
  CHECK(measured.inner_node.empty());
  const double sphere = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  scale(exact, std::cbrt(sphere / measured.reference_volume[0]));
  scale(cube, 0.5 * std::cbrt(sphere)); // of that volume, too, but no sphere
  double at = 0.2;
  for (GrainMesh* grain : {&exact, &on_nodes, &cube}) move(*grain, {0.5, 0.5, at}), at += 0.3;
  MeshedPacking packing = pack({exact, on_nodes, cube}, {1, 1, 1});
  packing.sphere_center = {0.5, 0.5, 0.2, 0.5, 0.5, 0.5, 0.5, 0.5, 0.8};
  packing.sphere_radius.assign(3, radius);
  const Model model = build_model(packing, holding_scenario(1e-9), "test");
  CHECK(model.smooth_grains == 1);
  const auto largest = [&](std::size_t grain) {
    return *std::max_element(model.inward.begin() + model.node_offset[grain],
                             model.inward.begin() + model.node_offset[grain + 1]);
  };
  CHECK(largest(0) > 0.01);
  CHECK(largest(1) == 0);
  CHECK(largest(2) == 0);
  packing.sphere_radius.pop_back();
  CHECK_THROWS_AS(build_model(packing, holding_scenario(1e-9), "test"), InputError);
  packing.sphere_radius = {radius, radius, std::numeric_limits<double>::quiet_NaN()};
  CHECK(build_model(packing, holding_scenario(1e-9), "test").smooth_grains == 1);
  // What a scenario says holds for every grain.
  Scenario facets = holding_scenario(1e-9);
  facets.contact.surface = ContactSurface::facets;
  CHECK(build_model(packing, facets, "test").smooth_grains == 0);
  CHECK(smooth_model(packing).smooth_grains == 3);
}

TEST_CASE("bonds of contact points behind the surface keep the ledger and take their fracture energy") {
  constexpr double fracture_energy = 0.005;
  Scenario scenario =
      bonded_scenario(table_1(fracture_energy), {grip("press", -4e-3, 1000), grip("pull", 1.6e-2, 1000)});
  scenario.contact.surface = ContactSurface::smooth;
  ThreadTeam team(1);
  Simulation simulation(build_model(two_balls(6), scenario, "test"), scenario, team);
  const Record record = run_stages(simulation, scenario);
  CHECK(record.last.front().bonds > 0);
  CHECK(record.last.back().bonds == 0);
  CHECK(record.worst_residual < 2e-3); // as with nodes themselves (test_bonded_balls.cpp)
  BondSums sums;
  for (std::size_t pair = 0; pair < simulation.contact().candidates.pair_first.size(); ++pair)
    add_terms(sums, bond_sums(simulation.model(), simulation.contact(), static_cast<std::int32_t>(pair)));
  CHECK(within(sums.dissipated, 0.5 * fracture_energy * sums.formed_area, accumulated_rounding));
}
