// Bonded balls slid far over each other's facets and pulled apart fast: some seconds each.

#include <catch2/catch.hpp>

#include "tests/support/bonded_pair.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("bonds follow the material when one ball is sheared by a radius against the other") {
  for (const double fracture_energy : {0.01, 0.5}) {
    const Scenario scenario = bonded_scenario(
        table_1(fracture_energy), {grip("press", -0.01, 4000), grip("shear", 0, 8000, {pair_radius, 0, 0})});
    const MeshedPacking packing = two_balls(6);
    ThreadTeam team(1);
    Simulation simulation(build_model(packing, scenario, "test"), scenario, team);
    const Record record = run_stages(simulation, scenario);
    CHECK(record.last[0].bonds > 5);
    CHECK(record.last[1].mean_damage > 0.5);
    CHECK(record.worst_residual < 0.01);
    // Central forces between material points: what one grain is pulled by, the other one is.
    for (const PointBond& bond : simulation.contact().bond) {
      CHECK(bond.state.largest >= bond.separation - 1e-15);
      CHECK(std::isfinite(bond.separation));
    }
  }
}

TEST_CASE("a bonded pair keeps its ledger when pulled fast, and when pressed and slid at once") {
  const std::vector<std::vector<Stage>> programmes = {
      {grip("press", -0.005, 2000), grip("pull fast", 0.05, 10000)},
      {grip("press and slide", -0.01, 4000, {0.04, 0.02, 0})},
  };
  for (const auto& stages : programmes)
    for (const SofteningLaw softening : {SofteningLaw::exponential, SofteningLaw::energy}) {
      BondParameters bond = table_1(0.1);
      bond.softening = softening;
      const Record record = run_stages(two_balls(6), bonded_scenario(bond, stages));
      CHECK(record.worst_residual < 0.01);
      CHECK(record.last.back().damage_dissipation > 0);
    }
}
