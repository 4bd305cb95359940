// Grains that stick to rigid tools: strength and energy of their bonds in closed form.

#include <array>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/run/simulation.hpp"
#include "tests/support/driven_tools.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double height = 0.05; // mm, of a slab of 0.2 x 0.2 mm between two plates
constexpr BondParameters weak{.tensile_strength = 4, .shear_strength = 3, .fracture_energy = 0.01};
constexpr BondParameters strong{.tensile_strength = 40, .shear_strength = 40, .fracture_energy = 1};
constexpr std::size_t lower = 0, upper = 1;

ToolParameters sticky(ToolParameters tool, const BondParameters& bond) {
  tool.adhesion = bond;
  return tool;
}

/// The slab touches both plates. Poisson's ratio is 0: held plates carry the same stress everywhere.
Scenario slab_between_plates(const BondParameters& below, std::vector<Stage> stages, double friction = 0) {
  Scenario scenario = holding_scenario(1);
  scenario.material.poissons_ratio = 0;
  scenario.tools = {sticky(plane("lower", {0.5, 0.5, 0.5}, {0, 0, 1}, friction), below),
                    sticky(plane("upper", {0.5, 0.5, 0.5 + height}, {0, 0, -1}), strong)};
  scenario.stages = std::move(stages);
  return scenario;
}

MeshedPacking slab() {
  GrainMesh mesh = cube_mesh(4);
  for (auto& x : mesh.node) x = {0.1 * x[0], 0.1 * x[1], 0.5 * height * x[2]};
  move(mesh, {0.5, 0.5, 0.5 + 0.5 * height});
  return pack({mesh}, {1, 1, 1});
}

Stage moving(const std::string& name, const std::array<double, 3>& velocity, double duration, double damping = 0) {
  Stage stage = driven({{.tool = upper, .velocity = velocity}}, duration, damping);
  stage.name = name;
  std::get<ToolLoading>(stage.type).ramp_fraction = 1e-4; // at full speed at once: the first stages are short
  return stage;
}

/// The upper plate presses with about 10 MPa and waits.
std::vector<Stage> pressed() {
  return {moving("press", {0, 0, -500}, 2.5e-7, 1e6), moving("wait", {0, 0, 0}, 3e-6, 4e6)};
}

/// What a run showed, step by step.
struct Seen {
  double largest_area = 0;          ///< mm^2, bonded to the lower plate
  double largest_pull = 0;          ///< N, of the slab on the lower plate, upwards
  double largest_drag = 0;          ///< N, along x
  double push_at_largest_drag = 0;  ///< N
  double residual = 0, work = 0;    ///< mJ, largest
  std::vector<double> area, lost;   ///< at the ends of stages: mm^2 bonded, mJ dissipated, both of the lower plate
  std::vector<ToolLoad> on_lower{}; ///< at the ends of stages
};

Seen run(Simulation& simulation, std::size_t stages) {
  Seen seen;
  for (std::size_t stage = 0; stage < stages; ++stage) {
    if (stage > 0) { // at the time level at which the stage before ended
      simulation.begin_next_stage();
      simulation.advance();
    }
    for (int i = 0;; ++i) {
      simulation.evaluate_forces();
      const ToolLoad& load = simulation.tools().load(lower);
      seen.largest_area = std::max(seen.largest_area, load.bonded_area);
      seen.largest_pull = std::max(seen.largest_pull, load.force.z);
      if (load.force.x > seen.largest_drag)
        seen.largest_drag = load.force.x, seen.push_at_largest_drag = load.normal_force;
      const bool end = simulation.stage_complete();
      if (end || i % 50 == 0) {
        const HistoryRow row = simulation.observe();
        seen.residual = std::max(seen.residual, std::abs(row.energy_residual));
        seen.work = std::max(seen.work, std::abs(row.external_work));
      }
      if (end) break;
      simulation.advance();
    }
    seen.area.push_back(simulation.tools().load(lower).bonded_area);
    seen.lost.push_back(simulation.tools()[lower].adhesion_dissipation);
    seen.on_lower.push_back(simulation.tools().load(lower));
  }
  return seen;
}

/// mm^2, of the nodes of the lower face: what bonds to the plate act on.
double area_of_lower_face(const Model& model) {
  double area = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n)
    if (model.position[4 * n + 2] < 0.5 + 1e-9) area += model.reference_area[n];
  return area;
}

Seen run(const Scenario& scenario) {
  ThreadTeam team(1);
  Simulation simulation(build_model(slab(), scenario, "test"), scenario, team);
  return run(simulation, scenario.stages.size());
}

} // namespace

TEST_CASE("a slab that is pulled off a tool bears the strength of its bonds and takes their fracture energy") {
  // Slowly to the peak, some 1e-4 mm, then through the whole softening branch, 16 G/t = 0.04 mm.
  std::vector<Stage> stages = {moving("touch", {0, 0, -50}, 2e-7), moving("pull", {0, 0, 50}, 3e-6),
                               moving("part", {0, 0, 2000}, 3e-5)};
  const Scenario scenario = slab_between_plates(weak, stages);
  ThreadTeam team(1);
  Simulation simulation(build_model(slab(), scenario, "test"), scenario, team);
  const double area = area_of_lower_face(simulation.model());
  const Seen seen = run(simulation, stages.size());
  CHECK(within(seen.largest_area, area, 1e-12));
  CHECK(
      within(seen.largest_pull, weak.tensile_strength * area, 0.01)); // bonds at edges reach their peak with the others
  CHECK(seen.area.back() == 0);
  CHECK(within(seen.lost.back(), weak.fracture_energy * area, 1e-9));
  CHECK(simulation.tools()[upper].adhesion_dissipation == 0);
  CHECK(seen.residual < 2e-3 * seen.work);
}

TEST_CASE("a slab that is dragged along a tool first shears its bonds off and then rubs") {
  for (const double friction : {0.0, 0.3}) {
    std::vector<Stage> stages = pressed();
    stages.push_back(moving("drag", {50, 0, 0}, 4e-6));
    stages.push_back(moving("slide", {2000, 0, 0}, 3.5e-5));
    stages.push_back(moving("creep", {200, 0, 0}, 3e-6, 4e6));
    const Scenario scenario = slab_between_plates(weak, stages, friction);
    ThreadTeam team(1);
    Simulation simulation(build_model(slab(), scenario, "test"), scenario, team);
    const double area = area_of_lower_face(simulation.model());
    const Seen seen = run(simulation, stages.size());
    const ToolLoad& end = seen.on_lower.back();
    CHECK(seen.area.back() == 0);
    CHECK(within(seen.lost.back(), weak.fracture_energy * area, 1e-9)); // whatever the pressure
    CHECK(std::abs(end.force.x - friction * end.normal_force) < 0.02 * friction * end.normal_force + 1e-6);
    // Without friction exactly the strength; with it nearly strength and friction together (docs/physics.md).
    if (friction == 0) CHECK(within(seen.largest_drag, weak.shear_strength * area, 0.02));
    if (friction > 0) {
      const double both = weak.shear_strength * area + friction * seen.push_at_largest_drag;
      CHECK(seen.largest_drag < 1.001 * both);
      CHECK(seen.largest_drag > 0.9 * both);
    }
    CHECK(seen.residual < 5e-3 * seen.work);
  }
}

TEST_CASE("a grain that sticks to a tool hangs from it and moves with it") {
  constexpr double gravity = 2e9; // mm/s^2: 0.16 MPa of weight
  std::vector<Stage> stages = pressed();
  stages.push_back(moving("hang", {0, 0, 0}, 6e-6, 4e6));
  stages.push_back(moving("go", {1000, 0, 0}, 6e-6));
  std::get<ToolLoading>(stages[2].type).away = std::get<ToolLoading>(stages[3].type).away = {lower};
  Scenario scenario = slab_between_plates(weak, stages);
  scenario.tools[lower].adhesion.reset();
  scenario.gravity = {0, 0, -gravity};
  ThreadTeam team(1);
  Simulation simulation(build_model(slab(), scenario, "test"), scenario, team);
  run(simulation, 3);
  const Model& model = simulation.model();
  double mass = 0;
  for (const double inverse : model.inverse_mass) mass += 1 / inverse;
  CHECK(within(-simulation.tools().load(upper).force.z, mass * gravity, 0.01));
  simulation.begin_next_stage();
  const double start = model.position[0];
  simulation.advance();
  finish_stage(simulation);
  const double way = simulation.tools()[upper].moved[0];
  CHECK(way > 3e-3);
  CHECK(std::abs(model.position[0] - start - way) < 0.01 * way); // it swings on its bonds
  CHECK(simulation.tools()[upper].adhesion_dissipation == 0);
}

TEST_CASE("a tool that is taken away leaves what stuck to it, with its energy in the ledger") {
  std::vector<Stage> stages = pressed();
  stages.push_back(moving("drag", {50, 0, 0}, 6e-7));
  stages.push_back(moving("free", {0, 0, 0}, 1e-6));
  std::get<ToolLoading>(stages[3].type).away = {lower, upper};
  std::get<ToolLoading>(stages[3].type).drives.clear();
  const Seen seen = run(slab_between_plates(strong, stages));
  CHECK(seen.area[2] > 0);
  CHECK(seen.on_lower[2].adhesion_energy > 0);
  CHECK(seen.area.back() == 0);
  // The forces of the moment at which the tools leave act for one more step, with bonds or without.
  CHECK(seen.residual < 0.03 * seen.work);
}

TEST_CASE("a broken bond to a tool forms again on contact only if its law says so") {
  for (const bool again : {false, true}) {
    BondParameters bond = weak;
    bond.rebond_on_contact = again;
    std::vector<Stage> stages = {moving("touch", {0, 0, -50}, 2e-7), moving("part", {0, 0, 2000}, 3e-5),
                                 moving("return", {0, 0, -2000}, 3e-5), moving("press", {0, 0, -100}, 1e-6),
                                 moving("part again", {0, 0, 2000}, 3e-5)};
    const Scenario scenario = slab_between_plates(bond, stages);
    ThreadTeam team(1);
    Simulation simulation(build_model(slab(), scenario, "test"), scenario, team);
    const double area = area_of_lower_face(simulation.model());
    const Seen seen = run(simulation, stages.size());
    CHECK(within(seen.lost[1], bond.fracture_energy * area, 1e-9));
    CHECK(seen.area[3] == (again ? seen.largest_area : 0.0));
    CHECK(within(seen.lost.back(), (again ? 2 : 1) * bond.fracture_energy * area, 1e-9));
  }
}
