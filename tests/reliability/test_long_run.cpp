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

namespace {

/// Elastic cubes, one below the other, that fly towards each other, touch, bond and vibrate.
Scenario vibrating_pair(double time_step_factor) {
  Scenario scenario = holding_scenario(1.0);
  scenario.bond = BondParameters{.tensile_strength = 1e6, .shear_strength = 1e6, .fracture_energy = 1e3};
  scenario.grain_velocity = {{0, 0, 500}, {0, 0, -500}};
  scenario.numerics.bulk_viscosity_linear = scenario.numerics.bulk_viscosity_quadratic = 0;
  scenario.numerics.time_step_factor = time_step_factor;
  return scenario;
}

HistoryRow after_steps(Simulation& simulation, int count) {
  for (int i = 0; i < count; ++i) {
    simulation.evaluate_forces();
    simulation.advance();
  }
  simulation.evaluate_forces();
  const HistoryRow row = simulation.observe();
  simulation.advance();
  return row;
}

} // namespace

// While two surfaces touch, the penalty is a spring, and central differences conserve the energy. In the step in which
// they first meet this does not hold: the spring acts for a part of the step only. What that leaves is of the order of
// the energy that the penalty takes up in one step, stiffness * (speed * step)^2, and falls with the square of the
// step.
TEST_CASE("the first touch leaves a residual that falls with the square of the step, and then it stays") {
  ThreadTeam team(1);
  const auto residual_after_touch = [&](double time_step_factor) {
    const Scenario scenario = vibrating_pair(time_step_factor);
    Simulation simulation(build_model(two_cubes(1), scenario, "test"), scenario, team);
    const int steps = static_cast<int>(20 / time_step_factor); // some 1.5e-7 s after the touch
    const double first = after_steps(simulation, steps).energy_residual;
    const HistoryRow row = after_steps(simulation, 50 * steps);
    const double energy = row.kinetic_energy + row.elastic_energy + row.contact_energy + row.bond_energy;
    CHECK(std::abs(row.energy_residual - first) < 0.05 * std::abs(first) + 1e-3 * energy);
    return std::abs(first) / energy;
  };
  // The first touch meets a step at any of its moments: a mean over steps of nearly the same length.
  const auto mean_residual = [&](double factor) {
    double sum = 0;
    for (const double part : {0.80, 0.85, 0.90, 0.95, 1.0}) sum += residual_after_touch(part * factor) / 5;
    return sum;
  };
  const double coarse = mean_residual(0.9), fine = mean_residual(0.225);
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.1);
  CHECK(fine < coarse / 8); // a sixteenth, but for the moments that the five steps happen to meet
}

TEST_CASE("a million steps of two bonded grains neither use more memory nor let the ledger drift") {
  const Scenario scenario = vibrating_pair(0.9);
  ThreadTeam team(1);
  Simulation simulation(build_model(two_cubes(1), scenario, "test"), scenario, team);
  const auto memory_used = [] { return static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd); };
  double energy = 0, drift = 0, first_residual = 0, first_memory = 0, memory = 0;
  for (int part = 0; part < 100; ++part) {
    const HistoryRow row = after_steps(simulation, 10'000);
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
