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
    // Every open bond is as long as from its node to the material point of the facet where it formed.
    const Model& model = simulation.model();
    const Contact& contact = simulation.contact();
    const auto at = [&](std::int32_t node) { return model.point(static_cast<std::size_t>(node)); };
    simulation.evaluate_forces();
    int open = 0;
    for (std::size_t p = 0; p < contact.bond.size(); ++p) {
      const PointBond& bond = contact.bond[p];
      if (!bond.intact() || !(bond.opening > 0)) continue;
      const std::int32_t* corner = &model.facet[3 * static_cast<std::size_t>(bond.facet)];
      const auto attachment = (1 - bond.weight1 - bond.weight2) * at(corner[0]) + bond.weight1 * at(corner[1]) +
                              bond.weight2 * at(corner[2]);
      CHECK(bond.separation ==
            Approx(norm(at(contact.candidates.point_node[p]) - attachment)).epsilon(1e-9).margin(1e-15));
      ++open;
    }
    if (fracture_energy > 0.1) CHECK(open > 0);
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
