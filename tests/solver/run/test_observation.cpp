// What is observed of a state: volumes, spread of the mass, forces of walls, energies of bonds.

#include <array>
#include <numeric>

#include <catch2/catch.hpp>

#include "common/table_reader.hpp"
#include "postproc/metrics/coordination.hpp"
#include "postproc/metrics/inner_stress.hpp"
#include "postproc/run_data/bond_table.hpp"
#include "results-schema/file.hpp"
#include "solver/model/model.hpp"
#include "solver/run/simulation.hpp"
#include "solver/scenario/read_scenario.hpp"
#include "tests/support/small_runs.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Eight bonded grains, compacted and held still with damping until they are at rest.
const std::string at_rest_text = material_text + R"([bond]
tensile_strength = 25
shear_strength = 18
fracture_energy = 0.01
softening = "energy"
[output]
history_rows = 10
[[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = 0.75
wall_speed = 20000
damping_rate = 1e6
damping_fade_stress = 1000
[[stages]]
name = "held"
type = "hold"
duration = 2e-5
damping_rate = 3e6
damping_fade_stress = 1e6
)";

/// Eight grains at the beginning of a scenario.
struct Beginning {
  Scenario scenario = read_scenario(TomlDocument::from_text(scenario_text, "test"));
  ThreadTeam team{1};
  Simulation simulation{build_model(eight_grains(2), scenario, "test"), scenario, team};
};

/// Moves every node from x to stretch * x; the box stays.
void stretch_grains(Model& model, const std::array<double, 3>& stretch) {
  for (std::size_t i = 0; i < model.position.size(); ++i)
    if (i % 4 < 3) model.position[i] *= stretch[i % 4];
}

} // namespace

TEST_CASE("the current density uses the grains' current volume, and so shows overlap that no node detects") {
  Beginning b;
  b.simulation.evaluate_forces();
  const HistoryRow before = b.simulation.observe();
  CHECK(within(before.relative_density_current, before.relative_density, accumulated_rounding));
  stretch_grains(b.simulation.model_to_disturb(), {1.3, 1.3, 1.3});
  const HistoryRow after = b.simulation.observe();
  CHECK(within(after.relative_density_current, 1.3 * 1.3 * 1.3 * before.relative_density, accumulated_rounding));
  CHECK(after.relative_density == before.relative_density);
}

TEST_CASE("the spread of the mass grows as the sample widens") {
  Beginning b;
  b.simulation.evaluate_forces();
  const HistoryRow before = b.simulation.observe();
  constexpr std::array<double, 3> stretch{1.02, 0.97, 0.9};
  stretch_grains(b.simulation.model_to_disturb(), stretch);
  const HistoryRow after = b.simulation.observe();
  for (std::size_t axis = 0; axis < 3; ++axis)
    CHECK(within(after.mass_spread[axis], stretch[axis] * before.mass_spread[axis], accumulated_rounding));
  // Two layers of grains on either side of the middle: nearly a quarter of the box, and a little for the grains' size.
  const double size = b.simulation.box().cell().length(0);
  CHECK(before.mass_spread[0] > 0.2 * size);
  CHECK(before.mass_spread[0] < 0.35 * size);
}

TEST_CASE("at rest Love and Weber's stress of all grains and walls is what the walls bear, and each bond's energy adds "
          "up to that of all") {
  const Folder folder;
  prepare(folder, 4, at_rest_text);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const auto walls = file.read(schema::run::history_wall_stress);
  const auto kinetic = file.read(schema::run::history_kinetic_energy);
  const Measurement whole = measure_inner_stress(file, -1, 1);
  const double p = whole.details["mean_stress_of_walls_MPa"].get<double>();
  CAPTURE(whole.value, p, kinetic.back());
  REQUIRE(p > 5);
  // Forces and stresses are of the same moment; what is left is inertia, places in single precision and the penalty's
  // depth, a hundredth of h.
  CHECK(within(whole.value, p, 2e-3));
  const std::size_t last = walls.size() - 6;
  CHECK(within(whole.details["stress_xx_MPa"].get<double>(), 0.5 * (walls[last] + walls[last + 1]), 5e-3));
  CHECK(within(whole.details["stress_zz_MPa"].get<double>(), 0.5 * (walls[last + 4] + walls[last + 5]), 5e-3));
  CHECK(within(whole.details["mean_stress_of_solid_MPa"].get<double>(), p, 0.02)); // with the penalty's own stress

  const std::string name = file.snapshots().back();
  const auto force = file.read(schema::run::snapshots_wall_force, name);
  const auto low = file.read(schema::run::snapshots_box_low, name),
             high = file.read(schema::run::snapshots_box_high, name);
  for (std::size_t side = 0; side < 6; ++side) {
    double sum = 0;
    for (std::size_t i = side; i < force.size(); i += 6) sum += force[i];
    const std::size_t y = (side / 2 + 1) % 3, z = (side / 2 + 2) % 3;
    CHECK(within(sum, walls[last + side] * (high[y] - low[y]) * (high[z] - low[z]), accumulated_rounding));
  }
  const auto of_bonds = file.read(schema::run::snapshots_bond_dissipation, name);
  const auto of_all = file.read(schema::run::history_damage_dissipation);
  REQUIRE(of_all.back() > 0);
  CHECK(within(std::accumulate(of_bonds.begin(), of_bonds.end(), 0.0), of_all.back(), accumulated_rounding));

  int broken = 0;
  for (const BondRow& bond : read_bond_table(file, -1))
    if (bond.broken()) {
      ++broken;
      // Broken where less than e^-16 of its energy is left; damage is rounded to 1 within 3e-8 of it.
      CHECK(within(*bond.dissipation, *bond.energy_to_break(), 1e-6));
    }
  CHECK(broken > 0);

  const Measurement coordination = measure_coordination(file, -1, 4);
  CHECK(coordination.details["coordination_number"].get<double>() ==
        file.read(schema::run::history_coordination_number).back());
  CHECK(coordination.details["coordination_number_with_walls"].get<double>() >
        coordination.details["coordination_number"].get<double>());
}
