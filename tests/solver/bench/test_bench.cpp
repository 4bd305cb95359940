// The built-in packing of the measurements, and the number type that counts the operations of a law.

#include <algorithm>

#include <catch2/catch.hpp>

#include "solver/bench/dense_packing.hpp"
#include "solver/bench/work.hpp"
#include "solver/physics/counted.hpp"
#include "solver/physics/tensor.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("the built-in packing is dense, free of overlap, and of about the requested size") {
  const DensePacking dense = make_dense_packing(60'000, 120, 1);
  CHECK(dense.packing.tet.size() / 4 > 42'000);
  CHECK(dense.packing.tet.size() / 4 < 84'000);
  CHECK(dense.relative_density > 0.7);
  CHECK(dense.relative_density < 0.95);
  // Building refuses inverted tets and open surfaces, the simulation refuses overlap and grains outside the box.
  Scenario scenario = holding_scenario(1e-9);
  scenario.walls = true;
  ThreadTeam team(1);
  const Simulation simulation(build_model(dense.packing, scenario, "dense"), scenario, team);
  CHECK(simulation.model().grains == static_cast<int>(dense.packing.grain_tet_offset.size()) - 1);
}

TEST_CASE("a counted number computes as a plain one and counts what it did") {
  const Vector3<Counted> a{1.0, 2.0, 3.0}, b{4.0, 5.0, 6.0};
  Counted::operations = 0;
  CHECK(dot(a, b).v == 32.0);
  CHECK(Counted::operations == 5); // three products, two sums
  Counted::operations = 0;
  CHECK(cross(a, b).z.v == -3.0);
  CHECK(Counted::operations == 9);
}

TEST_CASE("the work of contact is that of the points that touch, and of a search that of what it finds") {
  Scenario scenario = holding_scenario(1e-9);
  scenario.walls = false;
  ThreadTeam team(1);
  const DensePacking dense = make_dense_packing(2'000, 4, 1);
  Simulation simulation(build_model(dense.packing, scenario, "dense"), scenario, team);
  simulation.evaluate_forces();
  Contact contact = simulation.contact();
  REQUIRE(contact.candidates.point_facet.size() > 0);
  // A node above a facet's interior: differences 5 x 3, scalar products 6 x 5, areas 3 x 3, their sum 2, weights 2, the
  // closest point 18; and the distance 9.
  const Work search = work_of_search(simulation.model(), contact.candidates);
  CHECK(search.operations == 85.0 * static_cast<double>(contact.candidates.point_facet.size()));
  std::fill(contact.active.begin(), contact.active.end(), 0);
  const Work apart = work_of_contact(contact);
  CHECK(apart.operations == 0);
  CHECK(apart.bytes == 8.0 * static_cast<double>(contact.candidates.point_node.size()));
  contact.active[0] = 7;
  const Work touching = work_of_contact(contact);
  // The distance, the facet's area vector 15 and its product with the offset 5, stiffness 2, force 3, sum 3, energy 4
  // and depth 1, weights 2, reactions 3 x 6.
  CHECK(touching.operations == 7.0 * (85 + 15 + 5 + 2 + 3 + 3 + 4 + 1 + 2 + 18));
  CHECK(touching.bytes == apart.bytes + 7.0 * 548);
}

TEST_CASE("the work of a bond, of a search's surfaces and of the integration is that of their arrays") {
  Scenario scenario = holding_scenario(1e-9);
  scenario.walls = false;
  ThreadTeam team(1);
  Simulation simulation(build_model(make_dense_packing(2'000, 4, 1).packing, scenario, "dense"), scenario, team);
  const Model& model = simulation.model();
  CHECK(work_of_integration(model).bytes == 168.0 * model.nodes());
  // One pair of grains without a point: both surfaces are read, four bytes written for the end of the lists.
  ContactCandidates candidates;
  candidates.pair_first = {0};
  candidates.pair_second = {1};
  candidates.point_facet_offset = {0};
  CHECK(work_of_search(model, candidates).bytes == 32.0 * (model.surface_node_count[0] + model.surface_node_count[1]) +
                                                       12.0 * (model.facet_offset[2] - model.facet_offset[1]) + 4);
  Contact contact;
  contact.candidates.point_node = {0};
  contact.bond.resize(1);
  contact.active = {0};
  contact.pulling = {0};
  const Work sleeping = work_of_contact(contact);
  CHECK(sleeping.bytes == 20);
  contact.pulling = {1};
  CHECK(work_of_contact(contact).bytes == sleeping.bytes + 2.0 * sizeof(PointBond) + 128);
}

TEST_CASE("a tet that hardens takes 503 operations, and its history is read and written") {
  Scenario scenario = holding_scenario(1e-9);
  const Model model = build_model(make_dense_packing(2'000, 4, 1).packing, scenario, "dense");
  const Work tet = work_of_tet(model);
  CHECK(tet.operations == 503);
  // Seven stresses and strains, volume and length, and four node numbers read; the seven written; three rows a node.
  CHECK(within(tet.bytes, 9 * 8 + 4 * 4 + 7 * 8 + 96.0 * model.nodes() / model.tets(), rounding));
}
