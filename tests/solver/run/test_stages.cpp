// What single kinds of stages do: unloading to a stress, grips, masses scaled to a step.

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/stages/isotropic_unloading.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

GrainMesh single_cube() {
  GrainMesh cube = cube_mesh(4);
  scale(cube, 0.1);
  move(cube, {0.3, 0.3, 0.1});
  return cube;
}

/// Pulls one elastic cube between grips on its two faces to a strain of 1 %.
Scenario pulling_scenario(double speed) {
  Scenario scenario = holding_scenario(1e-6);
  scenario.stages[0].type = GripMotion{2, 1e-6, false, 0.002, {}, speed, 0.5};
  return scenario;
}

HistoryRow run_stage(Simulation& simulation) {
  for (;;) {
    simulation.evaluate_forces();
    if (simulation.stage_complete()) return simulation.observe();
    simulation.advance();
  }
}

} // namespace

TEST_CASE("grips stretch a cube to the stress of uniaxial tension, and their work is its energy") {
  const Scenario scenario = pulling_scenario(300);
  ThreadTeam team(1);
  Simulation simulation(build_model(pack({single_cube()}, {0.6, 0.6, 0.2}), scenario, "test"), scenario, team);
  const HistoryRow row = run_stage(simulation);
  CHECK(row.box_lengths[2] == Approx(0.202).epsilon(1e-12));
  // True stress E ln(1 + 1 %) on an area that shrank by 2 nu of that.
  const double strain = std::log(1.01), force = 5000 * strain * 0.04 * std::exp(-0.6 * strain);
  CHECK(-row.wall_stress[4] * 0.36 == Approx(force).epsilon(2e-3)); // the rest of the vibration
  CHECK(-row.wall_stress[5] * 0.36 == Approx(force).epsilon(2e-3));
  CHECK(row.external_work == Approx(0.5 * 5000 * strain * strain * 0.008).epsilon(5e-3));
  CHECK(std::abs(row.energy_residual) <
        2e-3 * row.external_work); // the elastic energy is good to first order of strain
}

TEST_CASE("grips that hold nothing are an error that names the face") {
  const Scenario scenario = pulling_scenario(300);
  ThreadTeam team(1);
  CHECK_THROWS_WITH(Simulation(build_model(pack({single_cube()}, {0.6, 0.6, 0.3}), scenario, "test"), scenario, team),
                    Catch::Contains("stage 'hold'") && Catch::Contains("high face"));
}

TEST_CASE("a packing unloads to zero stress, expands, and keeps its ledger") {
  Scenario scenario = holding_scenario(1e-6, HardeningLaw::power);
  scenario.walls = true;
  Stage load, unload;
  load.name = "load";
  load.type = IsotropicCompaction{0.62, 20000, 0.1};
  load.damping = {1e6, 5};
  unload.name = "unload";
  unload.type = IsotropicUnloading{0, 10000, 0.1};
  scenario.stages = {load, unload};
  ThreadTeam team(2);
  Simulation simulation(build_model(eight_grains(4), scenario, "test"), scenario, team);
  const HistoryRow loaded = run_stage(simulation);
  REQUIRE(loaded.mean_stress > 5);
  simulation.begin_next_stage();
  simulation.advance();
  const HistoryRow unloaded = run_stage(simulation);
  CHECK(unloaded.mean_stress <= 1e-2 * loaded.mean_stress); // one step after the target was met
  CHECK(unloaded.relative_density < loaded.relative_density);
  CHECK(unloaded.elastic_energy < 0.5 * loaded.elastic_energy);
  CHECK(unloaded.plastic_dissipation >= loaded.plastic_dissipation);
  CHECK(std::abs(unloaded.energy_residual) < 0.01 * unloaded.external_work);
}

TEST_CASE("an unloading that begins at its target or below ends there for any later stress") {
  const IsotropicUnloading unloading{1.0, 1000, 0.1};
  const Cell unit_cell{.high = {1, 1, 1}};
  const auto observe = [&](double stress) { return StageObservation{.cell = unit_cell, .mean_stress = stress}; };
  for (const double start : {0.5, 0.9999, 1.0}) {
    for (const double stress : {0.9, 1.0, 1.1}) {
      IsotropicUnloadingControl control(unloading, {"unloading"}, {.cell = unit_cell, .mean_stress = start});
      CHECK(control.ended());
      control.observe(observe(stress));
      CHECK(control.ended());
    }
    IsotropicUnloadingControl control(unloading, {"unloading"}, {.cell = unit_cell, .mean_stress = start});
    CHECK(control.fraction_done(0, start) == 1);
  }
  IsotropicUnloadingControl control(unloading, {"unloading"}, {.cell = unit_cell, .mean_stress = 2.0});
  CHECK_FALSE(control.ended());
  control.observe(observe(1.1));
  CHECK_FALSE(control.ended());
  control.observe(observe(1.0005));
  CHECK(control.ended());
}

TEST_CASE("masses scaled to a step allow that step and report what they added") {
  Scenario scenario = pulling_scenario(300);
  const MeshedPacking packing = pack({single_cube()}, {0.6, 0.6, 0.2});
  const auto stable_step = [&] {
    ThreadTeam team(1);
    Simulation simulation(build_model(packing, scenario, "test"), scenario, team);
    return std::pair{simulation.step_estimate().stable_step(), simulation.model().added_mass};
  };
  const double own = stable_step().first;
  scenario.numerics.mass_scaling_step = 2 * own;
  const auto [heavier_step, heavier] = stable_step();
  CHECK(heavier_step >= 2 * own * (1 - 1e-9));
  CHECK(heavier > 0.1);
  // With bonds that are far stiffer than the penalty, too.
  Scenario bonded = scenario;
  bonded.bond = BondParameters{25, 18, 0.05};
  bonded.bond->stiffness_factor = 100 * bonded.contact.stiffness_factor;
  ThreadTeam of_bonded(1);
  const Simulation held(build_model(packing, bonded, "test"), bonded, of_bonded);
  CHECK(held.step_estimate().stable_step() >= 2 * own * (1 - 1e-9));
  // Lighter: a smaller step than the mesh's own takes mass away.
  scenario.numerics.mass_scaling_step = 0.5 * own;
  CHECK(std::abs(stable_step().second) < 1e-12);
  scenario.numerics.mass_scaling_lighten = true;
  const auto [lighter_step, lighter] = stable_step();
  CHECK(lighter_step >= 0.5 * own * (1 - 1e-9));
  CHECK(lighter < -0.5);
  // The result of a slow process is the same.
  ThreadTeam team(1);
  Simulation simulation(build_model(packing, scenario, "test"), scenario, team);
  const HistoryRow row = run_stage(simulation);
  const double strain = std::log(1.01), force = 5000 * strain * 0.04 * std::exp(-0.6 * strain);
  CHECK(-row.wall_stress[5] * 0.36 == Approx(force).epsilon(2e-3));
  CHECK(std::abs(row.energy_residual) <
        2e-3 * row.external_work); // the elastic energy is good to first order of strain
}
