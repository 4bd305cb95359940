// Tools in hard cases: pressing from both ends, tools in each other, weight with scaled masses, a press that is taken
// away under load.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/die_column.hpp"
#include "tests/support/driven_tools.hpp"
#include "tests/support/small_runs.hpp"
#include "tests/support/small_tablet.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("pressed from both ends, the punches bear the same and the die nothing, by Janssen's law for half a column") {
  constexpr double nu = 0.4, mu = 0.3;
  const die_column::Pressed one = die_column::press({.n = 6}, nu, mu),
                            both = die_column::press({.n = 6, .both_ends = true}, nu, mu);
  INFO("transmission " << one.transmission << ", " << both.transmission << "; upper punch " << one.upper_force << ", "
                       << both.upper_force << " N after " << one.approach << ", " << both.approach << " mm");
  REQUIRE(one.transmission < 0.6);
  CHECK(within(both.transmission, 1, 0.02));
  CHECK(within(-one.die_force, (1 - one.transmission) * one.upper_force, 0.02));
  CHECK(std::abs(both.die_force) < 0.02 * both.upper_force);
  // An elastic column that gives by d needs s = d M x/(1 - exp(-x)) from one end, x = 4 mu K H/D, and from both ends
  // the same of its halves: (1 + exp(-x/2))/2 of it.
  const double ratio = both.upper_force / both.approach / (one.upper_force / one.approach);
  CHECK(within(ratio, 0.5 * (1 + std::sqrt(one.transmission)), 0.02));
}

// ------------------------------------------------------------------------------------------- tools in each other

namespace {

/// A cube of 0.2 mm between floors at z = 0.4 mm and a ram that comes down by 0.001 mm, at rest.
struct Pressed {
  double ram = 0;            ///< N
  std::vector<double> floor; ///< N
  HistoryRow row{};
};
Pressed press_block(std::vector<ToolParameters> floors) {
  Scenario scenario = holding_scenario(1);
  scenario.tools = std::move(floors);
  scenario.tools.push_back(plane("ram", {0.5, 0.5, 0.6001}, {0, 0, -1}));
  const std::size_t ram = scenario.tools.size() - 1;
  scenario.stages = {driven({{.tool = ram, .velocity = {0, 0, -500}, .direction = {0, 0, -1}}}, 1),
                     driven({}, 2e-5, 1e6)};
  std::get<ToolLoading>(scenario.stages[0].type).ends.travel = 0.0011;
  scenario.stages[1].name = "rest";
  ThreadTeam team(1);
  Simulation simulation(build_model(pack({block_in_the_middle()}, {1, 1, 1}), scenario, "test"), scenario, team);
  for (;; simulation.advance()) {
    simulation.evaluate_forces();
    if (!simulation.stage_complete()) continue;
    if (simulation.state().stage == 1) break;
    simulation.begin_next_stage();
  }
  Pressed pressed;
  pressed.row = simulation.observe();
  pressed.ram = simulation.tools()[ram].force[2];
  for (std::size_t tool = 0; tool < ram; ++tool) pressed.floor.push_back(-simulation.tools()[tool].force[2]);
  return pressed;
}

} // namespace

TEST_CASE("tools may overlap each other: two floors in one place bear half each, and a deeper one bears nothing") {
  const auto floor = [](const std::string& name, double z) { return plane(name, {0.5, 0.5, z}, {0, 0, 1}, 0.3); };
  const Pressed one = press_block({floor("floor", 0.4)}),
                two = press_block({floor("floor", 0.4), floor("again", 0.4), floor("deeper", 0.35)});
  REQUIRE(one.ram > 0.5);
  CHECK(within(two.floor[0], two.floor[1], 1e-9));
  CHECK(two.floor[2] == 0);
  CHECK(within(two.floor[0] + two.floor[1], two.ram, 0.01)); // the rest is vibration
  CHECK(within(two.ram, one.ram, 0.05));                     // two penalties give half as much
  CHECK(two.ram > one.ram);
  for (const Pressed& pressed : {one, two})
    CHECK(std::abs(pressed.row.energy_residual) < 1e-3 * pressed.row.external_work);
}

TEST_CASE("punches that stand beyond each other are refused: the grains are in one of them") {
  const Folder folder;
  prepare(folder, 3, replaced(tablet_text, "face = \"-z\"", "point = [0, 0, 0.3]\nnormal = [0, 0, 1]"));
  const Outcome outcome =
      mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Catch::Contains("into the tool 'lower'"));
}

// -------------------------------------------------------------------------------------------- weight and masses

TEST_CASE("a floor bears the weight of the grain's own mass, however its masses are scaled") {
  constexpr double gravity = 3e9, edge = 0.2; // mm/s^2, mm: a pressure of 1 MPa
  Scenario scenario = holding_scenario(1);
  scenario.gravity = {0, 0, -gravity};
  scenario.tools = {plane("floor", {0.5, 0.5, 0.4}, {0, 0, 1}, 0.3)};
  const double weight = scenario.material.density * edge * edge * edge * gravity;
  struct Scaling {
    double factor, step;
    bool lighten;
  };
  for (const Scaling& scaling : {Scaling{1, 0, false}, {4, 0, false}, {1, 2e-8, false}, {1, 2e-8, true}}) {
    scenario.numerics.mass_scaling = scaling.factor;
    if (scaling.step > 0) scenario.numerics.mass_scaling_step = scaling.step;
    scenario.numerics.mass_scaling_lighten = scaling.lighten;
    scenario.stages = {driven({}, 1e-4, 1e6)};
    ThreadTeam team(1);
    Simulation simulation(build_model(pack({block_in_the_middle()}, {1, 1, 1}), scenario, "test"), scenario, team);
    CAPTURE(scaling.factor, scaling.step, scaling.lighten, simulation.model().added_mass);
    if (scaling.step > 0) REQUIRE(std::abs(simulation.model().added_mass) > 0.1);
    finish_stage(simulation);
    CHECK(within(-simulation.tools()[0].force[2], weight, 0.02)); // which still vibrates a little
    const HistoryRow row = simulation.observe();
    CHECK(std::abs(row.energy_residual) < 2e-3 * row.external_work);
  }
}

// ------------------------------------------------------------------------------------------ taken away under load

namespace {

/// Largest residual of the stage after a press to 0.5, over the largest work so far, where `away` names what is taken
/// away without unloading.
double residual_without(const std::string& away, const std::string& text = tablet_text) {
  const Folder folder;
  const std::string pressed = replaced(text.substr(0, text.find("[[stages]]\nname = \"hold\"")),
                                       "relative_density = 0.45", "relative_density = 0.5");
  prepare(folder, 4,
          pressed + fmt::format(R"([[stages]]
name = "without"
type = "tools"
away = ["plate", {}]
duration = 1e-6
)",
                                away));
  const Outcome outcome =
      mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const auto work = file.read(schema::run::history_external_work),
             residual = file.read(schema::run::history_energy_residual),
             kinetic = file.read(schema::run::history_kinetic_energy);
  const auto stage = file.read(schema::run::history_stage);
  const double most = *std::max_element(work.begin(), work.end());
  double largest = 0, before = 0, fastest = 0;
  for (std::size_t row = 0; row < work.size(); ++row) {
    if (stage[row] == 0) before = residual[row];
    if (stage[row] == 0) continue;
    largest = std::max(largest, std::abs(residual[row] - before));
    fastest = std::max(fastest, kinetic[row]);
  }
  REQUIRE(fastest > 1e-3 * most); // the grains fly apart
  return largest / most;
}

} // namespace

TEST_CASE("a ram that is taken away within some steps of its impact takes the push of that moment along") {
  // The work of one step is some hundredths of all so far.
  Scenario scenario = holding_scenario(1);
  scenario.tools = {plane("floor", {0.5, 0.5, 0.4}, {0, 0, 1}, 0.3), plane("ram", {0.5, 0.5, 0.6001}, {0, 0, -1}, 0.3)};
  const ToolDrive ram{.tool = 1, .velocity = {2000, 0, -4000}, .direction = {0, 0, -1}};
  scenario.stages = {driven({ram}, 3e-7), driven({}, 1e-7)};
  std::get<ToolLoading>(scenario.stages[0].type).ramp_fraction = 1e-4;
  std::get<ToolLoading>(scenario.stages[1].type).away = {0, 1};
  scenario.stages[1].name = "away";
  ThreadTeam team(1);
  Simulation simulation(build_model(pack({block_in_the_middle()}, {1, 1, 1}), scenario, "test"), scenario, team);
  finish_stage(simulation);
  const HistoryRow pressed = simulation.observe();
  REQUIRE(pressed.external_work > 0);
  REQUIRE(simulation.tools()[1].force[2] > 0);
  simulation.begin_next_stage();
  simulation.advance();
  simulation.evaluate_forces();
  const HistoryRow free = simulation.observe();
  CHECK(simulation.tools()[1].force[2] == 0);
  INFO(simulation.state().step << " steps; residual " << pressed.energy_residual << ", " << free.energy_residual
                               << " of " << pressed.external_work);
  CHECK(std::abs(free.energy_residual - pressed.energy_residual) < 1e-3 * pressed.external_work);
}

TEST_CASE("a die, a punch or all of them may be taken away under full load: the ledger closes") {
  CHECK(residual_without("\"die\"") < 1e-3);
  CHECK(residual_without("\"upper\"") < 1e-3);
  CHECK(residual_without("\"die\", \"upper\", \"lower\"") < 1e-3);
}
