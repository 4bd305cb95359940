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
  const auto memory_used = [] { return static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd); };
  double energy = 0, drift = 0, first_residual = 0, first_memory = 0, memory = 0;
  for (int part = 0; part < 100; ++part) {
    const HistoryRow row = steps(10'000);
    energy = std::max({energy, row.kinetic_energy, row.elastic_energy + row.contact_energy + row.bond_energy});
    if (part == 0) first_residual = row.energy_residual;
    drift = std::max(drift, std::abs(row.energy_residual - first_residual));
    (part < 10 ? first_memory : memory) = std::max(part < 10 ? first_memory : memory, memory_used());
  }
  CAPTURE(energy, first_residual / energy, drift / energy, first_memory, memory, simulation.state().step);
  REQUIRE(simulation.state().step >= 1'000'000);
  // Lists of candidates breathe by some entries; a leak of a byte in every hundred steps would be 9,000 bytes.
  CHECK(memory <= first_memory + 8192);
  CHECK(drift < 0.01 * energy);
  WARN("drift of the ledger over energy " << drift / energy << ", memory " << first_memory << " B, then " << memory);
}
