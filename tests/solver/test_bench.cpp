// The built-in packing of the measurements, and the counted number that tells the operations of a law.

#include <catch2/catch.hpp>

#include "solver/bench/dense_packing.hpp"
#include "solver/physics/counted.hpp"
#include "solver/physics/tensor.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("the packing of the measurements is dense, free of overlap, and of about the size asked for") {
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
