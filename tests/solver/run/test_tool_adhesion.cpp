// Grains that stick to rigid tools: strength and energy of their bonds in closed form.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "solver/run/simulation.hpp"
#include "tests/support/driven_tools.hpp"
#include "tests/support/folder.hpp"
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

/// N, what snapshots show as the traction of tools, summed over all surface nodes.
double push_on_nodes(const Simulation& simulation) {
  const Model& model = simulation.model();
  double push = 0;
  for (int n = 0; n < model.surface_node_count[0]; ++n)
    push += simulation.tools().push_on_node(model, static_cast<std::size_t>(n), 0);
  return push;
}

/// What a run showed, step by step.
struct Seen {
  double largest_area = 0;          ///< mm^2, bonded to the lower plate
  double largest_pull = 0;          ///< N, of the slab on the lower plate, upwards
  double largest_drag = 0;          ///< N, along x
  double push_at_largest_drag = 0;  ///< N
  double least_normal_force = 0;    ///< N, on the lower plate
  double largest_imbalance = 0;     ///< N, of what nodes bear against what the plates bear along their normals
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
      seen.least_normal_force = std::min(seen.least_normal_force, load.normal_force);
      if (load.force.x > seen.largest_drag)
        seen.largest_drag = load.force.x, seen.push_at_largest_drag = load.normal_force;
      const bool end = simulation.stage_complete();
      if (end || i % 50 == 0) {
        seen.largest_imbalance = std::max(
            seen.largest_imbalance, std::abs(push_on_nodes(simulation) - simulation.tools().total().normal_force));
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
  const Folder folder;
  write_text(folder / "floor.stl", slab_stl({0, 0, 0.2}, {1, 1, 0.5}));
  for (const bool triangles : {false, true}) {
    CAPTURE(triangles);
    Scenario scenario = slab_between_plates(weak, stages);
    if (triangles) scenario.tools[lower].shape = StlShape{folder / "floor.stl", 1000, false, {}};
    ThreadTeam team(1);
    Simulation simulation(build_model(slab(), scenario, "test"), scenario, team);
    const double area = area_of_lower_face(simulation.model());
    const Seen seen = run(simulation, stages.size());
    CHECK(within(seen.largest_area, area, 1e-12));
    // Bonds at edges reach their peak with the others.
    CHECK(within(seen.largest_pull, weak.tensile_strength * area, 0.01));
    CHECK(within(-seen.least_normal_force, seen.largest_pull, 1e-9));
    CHECK(seen.largest_imbalance < 1e-9 * seen.largest_pull);
    CHECK(seen.area.back() == 0);
    CHECK(within(seen.lost.back(), weak.fracture_energy * area, 1e-9));
    CHECK(simulation.tools()[upper].adhesion_dissipation == 0);
    CHECK(seen.residual < 2e-3 * seen.work);
  }
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

TEST_CASE("a tool that was away bonds again to nodes that it had held only if its law says so") {
  for (const bool again : {false, true}) {
    BondParameters bond = weak;
    bond.rebond_on_contact = again;
    std::vector<Stage> stages = {moving("touch", {0, 0, -50}, 2e-7), moving("away", {0, 0, 0}, 1e-6),
                                 moving("press", {0, 0, -100}, 1e-6), moving("part", {0, 0, 2000}, 3e-5)};
    std::get<ToolLoading>(stages[1].type).away = {lower, upper};
    std::get<ToolLoading>(stages[1].type).drives.clear();
    const Seen seen = run(slab_between_plates(bond, stages));
    CHECK(seen.area[0] > 0);
    CHECK(seen.area[1] == 0);
    CHECK(seen.lost[1] == 0);
    CHECK(seen.area[2] == (again ? seen.area[0] : 0.0));
    CHECK((seen.lost.back() > 0) == again);
  }
}

TEST_CASE("bonds to tools that are far stiffer than the penalty do not shorten the step too late") {
  for (const ContactSurface surface : {ContactSurface::facets, ContactSurface::smooth}) {
    BondParameters stiff = strong;
    stiff.stiffness_factor = 10000; // a thousand times the penalty
    Scenario scenario = slab_between_plates(stiff, pressed());
    scenario.contact.surface = surface;
    const Seen seen = run(scenario);
    CHECK(seen.area.back() > 0);
    CHECK(seen.residual < 0.01 * seen.work); // diverging runs have residuals above the work
  }
}

namespace {

constexpr std::size_t tried_node = 0; // on the surface of its grain
constexpr Bounds everywhere{{-9, -9, -9}, {9, 9, 9}};

/// Force (N) of the tools on the node where it is; what they remember is updated.
Eigen::Vector3d force_on_node(Tools& tools, Model& model) {
  std::fill(model.force.begin(), model.force.end(), 0.0);
  tools.add_forces(model, everywhere, 0, 0);
  return Eigen::Vector3d(&model.force[4 * tried_node]);
}

/// Largest stiffness (N/mm) of the tools at the node, by differences of their forces. History is frozen.
double largest_stiffness(const Tools& tools, Model& model) {
  constexpr double step = 1e-8; // mm; tangential displacements are some 1e-4 mm
  Eigen::Matrix3d stiffness;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    double& x = model.position[4 * tried_node + static_cast<std::size_t>(axis)];
    const double here = x;
    Eigen::Vector3d force[2];
    for (const int side : {0, 1}) {
      x = here + (side == 0 ? -step : step);
      Tools moved = tools;
      force[side] = force_on_node(moved, model);
    }
    x = here;
    stiffness.col(axis) = -(force[1] - force[0]) / (2 * step);
  }
  return Eigen::EigenSolver<Eigen::Matrix3d>(stiffness, false).eigenvalues().real().maxCoeff();
}

} // namespace

TEST_CASE("no state of a node that rubs on a curved tool is stiffer than its bound, half damaged bonds included") {
  // As in test_friction.cpp of physics, where both bodies have nodes. Sliding makes the stiffness unsymmetric.
  Scenario scenario = holding_scenario(1);
  scenario.contact.surface = ContactSurface::facets;
  GrainMesh ball = ball_mesh(3, 0.1);
  move(ball, {0.5, 0.5, 0.5});
  Model model = build_model(pack({ball}, {1, 1, 1}), scenario, "test");
  const double penalty = surface_penalty(model, tried_node, 0);
  constexpr double radius = 0.3; // mm; the ball touches none of these
  const ToolSurface surfaces[] = {
      SphereSurface{{2, 0.5, 0.5}, radius, false}, SphereSurface{{0.5, 0.5, 0.5}, radius, true},
      CylinderSurface{2, {0.5, 0.5, 0.5}, radius, true, std::numeric_limits<double>::infinity(), 0}};
  std::mt19937 random(7);
  std::normal_distribution<double> sidewards(0, 2e-4);
  std::uniform_real_distribution<double> anywhere(-1, 1), depth(2e-4, 2e-3);
  int half_damaged = 0, rubbing = 0, open = 0;
  double largest = 0, excess = -1;
  for (const ToolSurface& surface : surfaces)
    for (const double ratio : {0.3, 1.0, 2.0})
      for (int trial = 0; trial < 200; ++trial) {
        const double b = ratio * penalty, strength = 1e-4 * b; // damage begins at 1e-4 mm
        Tool tool{.name = "tool", .surface = surface, .friction = 0.3};
        tool.adhesion = Adhesion{BondLaw{.stiffness = b,
                                         .tensile_strength = strength,
                                         .shear_strength = strength,
                                         .fracture_energy = 1e-6 * b / 2,
                                         .softening = SofteningLaw::energy}};
        Tools tools({tool}, 1);
        Eigen::Map<Eigen::Vector3d> place(&model.position[4 * tried_node]);
        // Brings the node to a distance from the surface.
        const auto bring_to = [&](double distance) {
          std::visit(
              [&](const auto& shape) {
                const auto gap = shape.gap([&](std::size_t axis) { return place[static_cast<Eigen::Index>(axis)]; });
                const Vector3<double> n = gap.normal.vector();
                place += (distance - gap.distance) * Eigen::Vector3d(n.x, n.y, n.z);
              },
              surface);
        };
        const double inside = depth(random);
        const bool outside = std::holds_alternative<SphereSurface>(surface) && !std::get<SphereSurface>(surface).inside;
        place = outside ? Eigen::Vector3d(1.8, 0.5, 0.5) : Eigen::Vector3d(0.7, 0.5, 0.5);
        place += 0.1 * Eigen::Vector3d(anywhere(random), anywhere(random), anywhere(random));
        for (int i = 0; i < 8; ++i) {
          place += Eigen::Vector3d(sidewards(random), sidewards(random), sidewards(random));
          bring_to(-inside);
          force_on_node(tools, model);
        }
        if (trial % 4 == 0) bring_to(1e-5), force_on_node(tools, model), ++open; // pulled off: only its bond is left
        std::vector<double> rate(static_cast<std::size_t>(model.nodes()), 0.0);
        tools.add_stiffness_rate(model, everywhere, 0, rate);
        const double bound = rate[tried_node] / model.inverse_mass[tried_node];
        const double remaining = tools.bonds(0, 0).front().remaining;
        half_damaged += remaining > 0.05 && remaining < 0.95 ? 1 : 0;
        rubbing += tools.anchors(0, 0).empty() ? 0 : 1;
        if (bound == 0) { // open, and its bond is broken
          CHECK(remaining == 0);
          continue;
        }
        const double found = largest_stiffness(tools, model) / bound;
        largest = std::max(largest, found);
        excess = std::max(excess, found - 1 - inside / radius);
      }
  CHECK(half_damaged > 300);
  CHECK(rubbing > 1000);
  CHECK(open > 300);
  // The push turns with the normal of the surface. The bound leaves that out: it is at most the penalty times the depth
  // over the radius.
  CHECK(excess < 0);
  CHECK(largest > 0.9);
}
