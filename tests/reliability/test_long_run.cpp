// A million steps of two bonded grains that vibrate.

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <malloc.h>

#include "solver/run/simulation.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("a million steps of two bonded grains neither use more memory nor let the ledger drift") {
  Scenario scenario = holding_scenario(1.0);
  scenario.bond = BondParameters{.tensile_strength = 1e6, .shear_strength = 1e6, .fracture_energy = 1e3};
  scenario.grain_velocity = {{0, 0, 500}, {0, 0, -500}};
  scenario.numerics.bulk_viscosity_linear = scenario.numerics.bulk_viscosity_quadratic = 0;
  ThreadTeam team(1);
  Simulation simulation(build_model(two_cubes(1), scenario, "test"), scenario, team);
  const auto steps = [&](int count) {
    for (int i = 0; i < count; ++i) {
      simulation.evaluate_forces();
      simulation.advance();
    }
    simulation.evaluate_forces();
    const HistoryRow row = simulation.observe();
    simulation.advance();
    return row;
  };
  steps(10'000);
  const auto memory = mallinfo2().uordblks + mallinfo2().hblkhd;
  double energy = 0, early = 0, late = 0;
  for (int part = 0; part < 99; ++part) {
    const HistoryRow row = steps(10'000);
    energy = std::max({energy, row.kinetic_energy, row.elastic_energy + row.contact_energy + row.bond_energy});
    double& worst = part < 10 ? early : late;
    worst = std::max(worst, std::abs(row.energy_residual));
  }
  CAPTURE(energy, early / energy, late / energy, simulation.state().step, simulation.state().time);
  REQUIRE(simulation.state().step >= 1'000'000);
  CHECK(mallinfo2().uordblks + mallinfo2().hblkhd <= memory + 4096);
  CHECK(late < 0.01 * energy);
  CHECK(late < 2 * early + 1e-6 * energy);
  WARN("residual over energy: " << early / energy << " in the first tenth, " << late / energy << " after");
}
