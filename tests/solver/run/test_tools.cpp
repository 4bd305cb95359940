// Rigid tools and gravity: known motions and forces, what a press does to the ledger, and that runs with tools are the
// same on any threads and when resumed. Their surfaces alone: test_tool_surfaces.cpp.

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/table_reader.hpp"
#include "results-schema/file.hpp"
#include "solver/output/tool_geometry.hpp"
#include "solver/run/make_tools.hpp"
#include "solver/scenario/read_scenario.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/die_column.hpp"
#include "tests/support/driven_tools.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/small_runs.hpp"
#include "tests/support/small_tablet.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

using Vector = Eigen::Vector3d;

/// Momentum (tonne mm/s) and mass (tonne) of all grains.
struct Motion {
  double mass = 0;
  Vector momentum = Vector::Zero(), centre = Vector::Zero();
};
Motion motion_of(const Model& m) {
  Motion motion;
  for (std::size_t n = 0; n < static_cast<std::size_t>(m.nodes()); ++n) {
    const double mass = 1 / m.inverse_mass[n];
    motion.mass += mass;
    for (std::size_t a = 0; a < 3; ++a) {
      motion.momentum[static_cast<Eigen::Index>(a)] += mass * m.velocity[4 * n + a];
      motion.centre[static_cast<Eigen::Index>(a)] += mass * m.position[4 * n + a];
    }
  }
  motion.centre /= motion.mass;
  return motion;
}

} // namespace

// ------------------------------------------------------------------------------------------------------ gravity

TEST_CASE("a ball that falls gains the momentum of its true weight and as much energy as it loses potential") {
  constexpr double gravity = 1e9; // mm/s^2
  Scenario scenario = holding_scenario(1);
  scenario.gravity = {0, 0.6 * gravity, -0.8 * gravity};
  double true_mass = 0;
  for (const auto& [factor, scaled_step] : {std::pair{1.0, 0.0}, {4.0, 0.0}, {1.0, 2e-8}}) {
    scenario.numerics.mass_scaling = factor;
    scenario.numerics.mass_scaling_step = scaled_step;
    GrainMesh ball = ball_mesh(4, 0.1);
    move(ball, {0.5, 0.5, 0.5});
    ThreadTeam team(1);
    Simulation simulation(build_model(pack({ball}, {1, 1, 1}), scenario, "test"), scenario, team);
    const auto [mass, momentum, start] = motion_of(simulation.model());
    if (true_mass == 0) true_mass = mass;
    CAPTURE(factor, scaled_step, mass / true_mass);
    REQUIRE((mass > 1.1 * true_mass) == (factor > 1 || scaled_step > 0));
    const double acceleration = gravity * true_mass / mass;
    for (int i = 0; i < 1000; ++i) {
      simulation.evaluate_forces();
      simulation.advance();
    }
    simulation.evaluate_forces();
    const double t = simulation.state().time, step = simulation.state().last_step;
    const Motion motion = motion_of(simulation.model());
    // The velocity is that of half a step before; the first step of central differences begins with half a step.
    CHECK(within(motion.momentum.norm(), true_mass * gravity * (t - 0.5 * step), 2e-3));
    CHECK(within((motion.centre - start).norm(), 0.5 * acceleration * t * t, 2e-3));
    const HistoryRow row = simulation.observe();
    REQUIRE(row.kinetic_energy > 0);
    CHECK(std::abs(row.energy_residual) < 1e-6 * row.kinetic_energy);
  }
}

TEST_CASE("a branch with another gravity begins with the work of the run before") {
  const Folder folder;
  prepare(folder, 3, material_text + R"([gravity]
acceleration = [0, 0, -1e8]
[[stages]]
name = "fall"
type = "tools"
duration = 2e-6
)");
  const std::string run = fmt::format("run {} --quiet -o ", folder / "scenario.toml");
  REQUIRE(mpfem_command(run + (folder / "run.h5")).exit_code == 0);
  const auto branch = [&](const std::string& options) {
    REQUIRE(
        mpfem_command(run + (folder / "branch.h5 --from ") + (folder / "run.fall.checkpoint.h5") + options).exit_code ==
        0);
    const schema::FileReader file(folder / "branch.h5", schema::FileKind::run);
    return file.read(schema::run::history_external_work);
  };
  const auto work = schema::FileReader(folder / "run.h5").read(schema::run::history_external_work);
  REQUIRE(work.back() > 0);
  CHECK(within(branch("").front(), work.back(), 1e-12));
  // Its potential has another origin, and is many times the work of the fall.
  const auto sideways = branch(" --set gravity.acceleration=[1e8,0,0]");
  CAPTURE(work.back(), sideways.front(), sideways.back());
  CHECK(within(sideways.front(), work.back(), 1e-12));
  CHECK(sideways.back() > work.back());
}

TEST_CASE("a scenario may have gravity and masses scaled to a step") {
  const Folder folder;
  prepare(folder, 4, tablet_text);
  const Outcome outcome =
      mpfem_command(fmt::format("check {} --set numerics.mass_scaling_step=1e-8", folder / "scenario.toml"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("a block on an inclined plane rests for a million steps below the angle of friction and slides above it") {
  constexpr double edge = 0.2, gravity = 3e9, mu = 0.3; // mm, mm/s^2: a pressure of 1 MPa
  for (const double steepness : {0.9, 2.0}) {           // tan(angle)/mu
    const double angle = std::atan(steepness * mu), s = std::sin(angle), c = std::cos(angle);
    Scenario scenario = holding_scenario(1);
    scenario.gravity = {0, 0, -gravity};
    scenario.tools = {plane("incline", {1, 1, 1}, {s, 0, c}, mu)};
    scenario.stages = {driven({}, 4e-5, 1e6), driven({}, 1)};
    scenario.stages[1].name = "free";
    GrainMesh slab = cube_mesh(2);
    for (auto& x : slab.node) x = {0.5 * edge * x[0], 0.5 * edge * x[1], 0.25 * edge * x[2]};
    rotate(slab, {0, 1, 0}, angle); // z of the slab to the normal
    move(slab, {1 + 0.25 * edge * s, 1, 1 + 0.25 * edge * c});
    ThreadTeam team(1);
    Simulation simulation(build_model(pack({slab}, {4, 2, 2}), scenario, "test"), scenario, team);
    const auto advance = [&] {
      simulation.evaluate_forces();
      if (simulation.stage_complete()) simulation.begin_next_stage();
      simulation.advance();
    };
    while (simulation.state().stage == 0) advance();
    // Damped, the block slides so slowly that nodes stick and slip. They do so for some time afterwards.
    for (int i = 0; steepness > 1 && i < 4000; ++i) advance();
    const Motion before = motion_of(simulation.model());
    const double start = simulation.state().time;
    for (int i = 0; i < (steepness < 1 ? 1'000'000 : 24'000); ++i) advance();
    const Motion after = motion_of(simulation.model());
    const Vector down(c, 0, -s);
    if (steepness < 1) {
      // It still vibrates by some 1e-6 of an element when the million steps begin.
      CHECK((after.centre - before.centre).norm() < 1e-5 * simulation.model().element_size[0]);
      const Tool& incline = simulation.tools()[0];
      const double weight = after.mass * gravity;
      CHECK(within(-incline.force[2], weight, 0.01)); // which still vibrates a little
    } else {
      const double acceleration =
          (after.momentum - before.momentum).dot(down) / (after.mass * (simulation.state().time - start));
      // The push vibrates about the weight, as on the floor of the box (test_friction.cpp).
      CHECK(within(acceleration, gravity * (s - mu * c), 0.005));
    }
  }
}

// -------------------------------------------------------------------------------------------------------- tools

TEST_CASE("a stage of tools in a scene without tools lets its time pass") {
  Scenario scenario = holding_scenario(1);
  scenario.stages = {driven({}, 1e-7)};
  ThreadTeam team(1);
  GrainMesh ball = ball_mesh(3, 0.1);
  move(ball, {0.5, 0.5, 0.5});
  Simulation simulation(build_model(pack({ball}, {1, 1, 1}), scenario, "test"), scenario, team);
  finish_stage(simulation);
  CHECK(simulation.state().time >= 1e-7);
  CHECK(simulation.stage_result().ended_by == "duration 1e-07 s");
}

TEST_CASE("a tool that holds a force comes to rest where the grains carry it") {
  constexpr double force = 0.4; // N, on a block of 0.04 mm^2
  Scenario scenario = holding_scenario(1);
  scenario.tools = {plane("floor", {0.5, 0.5, 0.4}, {0, 0, 1}), plane("ram", {0.5, 0.5, 0.6001}, {0, 0, -1})};
  ToolDrive ram{.tool = 1, .direction = {0, 0, -1}, .force = force, .servo_speed = 500};
  scenario.stages = {driven({ram}, 4e-5, 1e6)};
  ThreadTeam team(1);
  Simulation simulation(build_model(pack({block_in_the_middle()}, {1, 1, 1}), scenario, "test"), scenario, team);
  finish_stage(simulation);
  CHECK(within(simulation.tools()[1].force[2], force, 0.02));
  CHECK(within(-simulation.tools()[0].force[2], force, 0.02));
  CHECK(simulation.tools()[1].moved[2] < -1e-4); // it closed its gap of 1e-4 mm first
}

TEST_CASE("The hold error of a tool counts from when it has reached its force, or all of it is missing") {
  constexpr double force = 0.4; // N; over the section of the box, 1 mm^2
  Scenario scenario = holding_scenario(1);
  scenario.tools = {plane("floor", {0.5, 0.5, 0.4}, {0, 0, 1}), plane("ram", {0.5, 0.5, 0.61}, {0, 0, -1})};
  const ToolDrive ram{.tool = 1, .direction = {0, 0, -1}, .force = force, .servo_speed = 500};
  const auto result_after = [&](double duration) {
    scenario.stages = {driven({ram}, duration, 1e6)};
    ThreadTeam team(1);
    Simulation simulation(build_model(pack({block_in_the_middle()}, {1, 1, 1}), scenario, "test"), scenario, team);
    finish_stage(simulation);
    return simulation.stage_result();
  };
  const StageResult held = result_after(6e-5);
  CHECK(within(held.hold_stress, force, rounding));
  CHECK(held.missed.empty());
  CHECK(held.hold_error > 0); // the ram meets the block at its full speed
  // On the way there the whole force is missing, for 2e-5 of 6e-5 s: that alone would give 0.58.
  CHECK(held.hold_root_mean_square < 0.3 * force);
  const StageResult missed = result_after(1.5e-5);
  CHECK(within(missed.hold_stress, force, rounding));
  CHECK(missed.missed == "'ram' 0 N instead of 0.4 N");
  CHECK(within(missed.hold_error, force, 0.01)); // an average over a transit, a tenth of that time
}

namespace {

constexpr double jaw_ball_radius = 0.1; // mm, of a ball in the middle of the box

/// A rounded jaw beside the ball: its surface begins at x = `surface` (mm) and it is hollow `towards` +x or -x.
ToolParameters jaw(const std::string& name, double surface, double towards) {
  constexpr double radius = 1.5 * jaw_ball_radius;
  return {.name = name,
          .shape = CylinderShape{
              .axis = 2, .centre = {{surface + towards * radius, 0.5, 0}}, .radius = radius, .inside = true}};
}

/// The left jaw and the right one push on the ball with this force (N).
std::vector<ToolDrive> jaws_that_push(double force, double servo_speed) {
  return {{.tool = 0, .direction = {1, 0, 0}, .force = force, .servo_speed = servo_speed},
          {.tool = 1, .direction = {-1, 0, 0}, .force = force, .servo_speed = servo_speed}};
}

Model ball_between_jaws(const Scenario& scenario) {
  GrainMesh ball = ball_mesh(4, jaw_ball_radius);
  move(ball, {0.5, 0.5, 0.5});
  return build_model(pack({ball}, {1, 1, 1}), scenario, "test");
}

} // namespace

TEST_CASE("rounded jaws that hold a force across their axes bear it on opposite sides of a ball") {
  constexpr double force = 0.2, radius = jaw_ball_radius, gap = 1e-4; // N, mm
  Scenario scenario = holding_scenario(1);
  scenario.tools = {jaw("left", 0.5 - radius - gap, 1), jaw("right", 0.5 + radius + gap, -1)};
  scenario.stages = {driven(jaws_that_push(force, 500), 4e-5, 1e6)};
  ThreadTeam team(1);
  Simulation simulation(ball_between_jaws(scenario), scenario, team);
  finish_stage(simulation);
  // The grain's force on a jaw is the reverse of the jaw's push; damping at 1e6/s leaves 2 % of vibration at most.
  CHECK(within(-simulation.tools()[0].force[0], force, 0.02));
  CHECK(within(simulation.tools()[1].force[0], force, 0.02));
  CHECK(std::abs(simulation.tools()[0].force[1]) < 0.02 * force);
  CHECK(simulation.tools()[0].moved[0] > gap); // both closed their gaps
  CHECK(simulation.tools()[1].moved[0] < -gap);
}

TEST_CASE("jaws that come back into a ball stand where they just touch it, and the stage ends when both push") {
  constexpr double force = 0.02, radius = jaw_ball_radius, depth = 0.3 * radius; // N, mm
  Scenario scenario = holding_scenario(1);
  // The left one would stand inside the ball, the right one has half of a radius to go.
  scenario.tools = {jaw("left", 0.5 - radius + depth, 1), jaw("right", 0.5 + 1.5 * radius, -1)};
  Stage away = driven({}, 1e-8), seat = driven(jaws_that_push(force, 2000), 1e-3, 1e6);
  std::get<ToolLoading>(away.type).away = {0, 1};
  std::get<ToolLoading>(seat.type).ends.forces_reached = true;
  scenario.stages = {away, seat};
  ThreadTeam team(1);
  Simulation simulation(ball_between_jaws(scenario), scenario, team);
  finish_stage(simulation);
  simulation.begin_next_stage();
  // The ball's outermost nodes lie on its surface, so this is the way out.
  CHECK(within(simulation.tools()[0].moved[0], -depth, 1e-3));
  CHECK(simulation.tools()[1].moved[0] == 0);
  const auto notes = simulation.tools().moved_back();
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::Contains(fmt::format("tool 'left' begins {:.3g} mm farther back", depth)));
  finish_stage(simulation);
  CHECK(simulation.stage_result().ended_by == "all forces reached");
  CHECK(simulation.stage_result().missed.empty());
  CHECK(-simulation.tools()[0].force[0] > 0);
  CHECK(simulation.tools()[1].force[0] >= force);
}

TEST_CASE("a direction lets every shape but a plane be driven by speed and force, and be watched along it") {
  const auto stage_of = [&](const std::string& shape, const std::string& keys) {
    const std::string text = replaced(replaced(tablet_text, "type = \"plane\"\nface = \"+x\"", shape),
                                      "travel = 0.02\ndrive.plate.speed = 10000", keys);
    const Scenario scenario = read_scenario(TomlDocument::from_text(text, "test"));
    return std::get<ToolLoading>(scenario.stages.back().type);
  };
  const std::string ball = "type = \"sphere\"\ncentre = [1, 0.3, 0.3]\nradius = 0.2";
  const std::string rod = "type = \"cylinder\"\ngrains = \"outside\"\ncentre = [1, 0.3, 0]\nradius = 0.2";
  for (const std::string& shape : {ball, rod}) {
    const ToolLoading pushed =
        stage_of(shape, "force_drop = 0.2\nwatch = \"plate\"\ndrive.plate = { speed = 10000, direction = [-3, 4, 0] }");
    CHECK(pushed.drives.at(0).velocity == std::array<double, 3>{-6000, 8000, 0});
    CHECK(pushed.ends.watched_direction == std::array<double, 3>{-0.6, 0.8, 0});
    const ToolLoading held =
        stage_of(shape, "duration = 1e-6\ndrive.plate = { force = 0.1, servo_speed = 1000, direction = [-2, 0, 0] }");
    CHECK(held.drives.at(0).direction == std::array<double, 3>{-1, 0, 0});
    CHECK(held.drives.at(0).force == 0.1);
  }
}

TEST_CASE("the push of a tool that is watched and not driven is that along its normal, without its friction") {
  constexpr double target = 0.05, mu = 0.8; // N, 1
  Scenario scenario = holding_scenario(1);
  scenario.gravity = {4e9, 0, -4e9};
  scenario.tools = {plane("floor", {0.5, 0.5, 0.4}, {0, 0, 1}, mu)};
  ToolLoading loading;
  loading.ends.force = target;
  loading.ends.watched_direction = {0, 0, 1};
  loading.ends.duration = 1e-5;
  Stage fall;
  fall.name = "fall";
  fall.type = loading;
  scenario.stages = {fall};
  GrainMesh ball = ball_mesh(4, 0.1);
  move(ball, {0.5, 0.5, 0.5001});
  ThreadTeam team(1);
  Simulation simulation(build_model(pack({ball}, {1, 1, 1}), scenario, "test"), scenario, team);
  finish_stage(simulation);
  CHECK(simulation.stage_result().ended_by == "force 0.05 N");
  const ToolLoad& load = simulation.tools().load(0);
  CHECK(std::abs(load.force.x) > 0.5 * mu * target); // it rubs: the force is larger than its push
  CHECK(-load.force.z >= target);
  CHECK(-load.force.z < 1.15 * target); // passed by what one step of the impact adds
}

TEST_CASE("a ball comes to rest in a cone, in a bowl and on a plane that bear its weight where it touches them") {
  constexpr double gravity = 4e9, radius = 0.1; // mm/s^2, mm
  const auto at_rest = [&](const ToolParameters& tool, const std::array<double, 3>& centre) {
    Scenario scenario = holding_scenario(1);
    scenario.gravity = {0, 0, -gravity};
    scenario.tools = {tool};
    scenario.stages = {driven({}, 3e-5, 1e6)};
    GrainMesh ball = ball_mesh(4, radius);
    move(ball, centre);
    ThreadTeam team(1);
    Simulation simulation(build_model(pack({ball}, {1, 1, 1}), scenario, "test"), scenario, team);
    finish_stage(simulation);
    const Motion motion = motion_of(simulation.model());
    const ToolLoad load = simulation.tools().load(0);
    const double weight = motion.mass * gravity;
    CHECK(within(-load.force.z, weight, 0.02)); // which still vibrates a little
    CHECK(std::hypot(load.force.x, load.force.y) < 0.02 * weight);
    return std::pair(motion.centre, (1 / weight) * load.moment);
  };
  // In a cone of 45 degrees the centre is R/sin(45 degrees) above the apex. Facets and penalty take some 0.01 R.
  const Vector in_cone =
      at_rest({.name = "cone", .shape = ConeShape{.apex = {0.5, 0.5, 0.3}, .half_angle = M_PI / 4, .inside = true}},
              {0.5, 0.5, 0.3 + 1.45 * radius})
          .first;
  CHECK(std::abs(in_cone[2] - 0.3 - std::sqrt(2.0) * radius) < 0.03 * radius);
  const Vector in_bowl =
      at_rest({.name = "bowl", .shape = SphereShape{{0.5, 0.5, 0.5}, 0.3, true}}, {0.5, 0.5, 0.3 + 0.01 * radius})
          .first;
  CHECK(std::abs(in_bowl[2] - 0.3) < 0.03 * radius);
  // The weight acts 0.2 mm from the plane's point.
  const auto moment = at_rest(plane("floor", {0.3, 0.5, 0.4}, {0, 0, 1}), {0.5, 0.5, 0.5 + 0.01 * radius}).second;
  CHECK(within(moment.y, 0.2, 0.03));
  CHECK(std::abs(moment.x) < 0.02 * radius);
  CHECK(std::abs(moment.z) < 1e-6);
}

TEST_CASE("the flat face of a body in an STL file pushes and rubs as a plane does") {
  const Folder folder;
  write_text(folder / "slab.stl", slab_stl({0, 0, 0.1}, {1, 1, 0.4}));
  write_text(folder / "elsewhere.stl", slab_stl({3, -2, 5.1}, {4, -1, 5.4}));
  std::vector<ToolLoad> loads;
  for (const int triangles : {0, 1, 2}) {
    Scenario scenario = holding_scenario(1);
    scenario.gravity = {1e9, 0, -4e9};
    scenario.tools = {plane("floor", {0.5, 0.5, 0.4}, {0, 0, 1}, 0.2)};
    if (triangles == 1) scenario.tools[0].shape = StlShape{folder / "slab.stl", 1000, false, {}};
    if (triangles == 2)
      scenario.tools[0].shape = StlShape{folder / "elsewhere.stl", 1000, false, std::array{0.0, 0.0, 0.1}};
    scenario.stages = {driven({}, 1)};
    GrainMesh ball = ball_mesh(4, 0.1);
    move(ball, {0.5, 0.5, 0.5001});
    ThreadTeam team(1);
    Simulation simulation(build_model(pack({ball}, {1, 1, 1}), scenario, "test"), scenario, team);
    double peak = 0;
    ToolLoad at_peak;
    for (int i = 0; i < 400; ++i) {
      simulation.evaluate_forces();
      if (const ToolLoad& load = simulation.tools().load(0); load.normal_force > peak)
        peak = load.normal_force, at_peak = load;
      simulation.advance();
    }
    loads.push_back(at_peak);
  }
  REQUIRE(loads[0].normal_force > 0.01); // N
  CHECK(loads[0].force.x != 0);          // it rubs
  for (const std::size_t file : {1U, 2U}) {
    CHECK(within(loads[file].normal_force, loads[0].normal_force, 1e-9));
    CHECK(within(loads[file].force.x, loads[0].force.x, 1e-6));
    CHECK(within(loads[file].force.z, loads[0].force.z, 1e-9));
  }
}

namespace {

/// Force of the lower over that of the upper punch, by finite elements, where the column is as high as wide.
double reference_transmission(double nu, double mu) {
  for (const std::vector<std::string>& row : read_reference("die_transmission.csv"))
    if (std::atof(row[0].c_str()) == nu && std::atof(row[1].c_str()) == mu && std::atof(row[2].c_str()) == 1)
      return std::stod(row[3]);
  throw std::runtime_error("die_transmission.csv has no such row");
}

} // namespace

TEST_CASE("friction of a die reduces the force from punch to punch as Janssen's law says") {
  // With 0.1 the whole wall slides, and the wall's own compliance is what is left of the error. With 0.3 the wall
  // sticks near the lower punch; the nodes at the column's edge there rub nevertheless, which costs a half of a cell's
  // share of the wall, 1/(2 n) = 4 % at n = 12, times the low pressure there.
  for (const auto& [nu, mu, tolerance] : {std::array{0.3, 0.1, 0.005}, std::array{0.4, 0.3, 0.03}}) {
    const die_column::Pressed pressed = die_column::press({.n = 12}, nu, mu);
    INFO("nu " << nu << ", mu " << mu << ": " << pressed.transmission);
    CHECK(within(pressed.transmission, reference_transmission(nu, mu), tolerance));
    CHECK(within(pressed.lost_at_tools, pressed.row.friction_dissipation, 1e-9));
    CHECK(std::abs(pressed.row.energy_residual) < 0.01 * pressed.row.external_work);
  }
}

// Twelve elements along the radius; plain tetrahedra are 2.2 % off there, nodal pressures 1.4 %.
TEST_CASE("with nodal pressures the force through a die whose friction is 0.3 is right within 2 %") {
  const die_column::Pressed pressed = die_column::press({.n = 12, .element = ElementType::tet4_anp}, 0.4, 0.3);
  CAPTURE(pressed.transmission);
  CHECK(within(pressed.transmission, reference_transmission(0.4, 0.3), 0.02));
}

namespace {

constexpr double disc_radius = 0.5, disc_thickness = 0.05; // mm

/// A disc with its axis along z, in the corner of the axes, of n cells along its radius: four mirrored quarters, so
/// that all cells are cut along the radius where two sides of the mapped square meet.
GrainMesh disc_mesh(int n) {
  const GrainMesh quarter = die_column::quarter_cylinder(n, 2, disc_radius, disc_thickness);
  GrainMesh disc;
  std::map<std::array<std::int64_t, 3>, std::int32_t> number;
  for (const auto& [sx, sy] : {std::array{1, 1}, std::array{-1, 1}, std::array{1, -1}, std::array{-1, -1}}) {
    std::vector<std::int32_t> node;
    for (const auto& x : quarter.node) {
      const std::array place = {disc_radius + sx * x[0], disc_radius + sy * x[1], 0.5 * disc_thickness + x[2]};
      std::array<std::int64_t, 3> key{};
      for (std::size_t axis = 0; axis < 3; ++axis) key[axis] = std::llround(1e9 * place[axis]);
      const auto [entry, is_new] = number.try_emplace(key, static_cast<std::int32_t>(disc.node.size()));
      if (is_new) disc.node.push_back(place);
      node.push_back(entry->second);
    }
    for (auto tet : quarter.tet) {
      for (std::int32_t& corner : tet) corner = node[static_cast<std::size_t>(corner)];
      if (sx != sy) std::swap(tet[2], tet[3]);
      disc.tet.push_back(tet);
    }
  }
  return disc;
}

/// Strains along x and y in the middle of the disc, to a ninth of its radius: the linear displacement nearest to that
/// of its nodes.
std::array<double, 2> strain_in_middle(const Model& model, const std::vector<double>& start) {
  std::array<double, 2> strain{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<std::array<double, 2>> place_and_shift;
    std::array<double, 2> mean{};
    for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n)
      if (std::hypot(start[4 * n] - disc_radius, start[4 * n + 1] - disc_radius) < 0.11 * disc_radius)
        place_and_shift.push_back({start[4 * n + axis], model.position[4 * n + axis] - start[4 * n + axis]});
    for (const auto& [x, u] : place_and_shift) mean[0] += x, mean[1] += u;
    for (double& m : mean) m /= static_cast<double>(place_and_shift.size());
    double xx = 0, xu = 0;
    for (const auto& [x, u] : place_and_shift) xx += (x - mean[0]) * (x - mean[0]), xu += (x - mean[0]) * (u - mean[1]);
    strain[axis] = xu / xx;
  }
  return strain;
}

} // namespace

// Hertz 1883; Timoshenko and Goodier, Theory of Elasticity, section 41: 2 P/(pi D t) across the load, three times that
// in compression along it. Without lateral contraction it holds for any thickness.
TEST_CASE("an elastic disc between plates has the stresses of the closed form in its middle") {
  constexpr double approach = 5e-4; // mm, of each plate
  Scenario scenario = holding_scenario(1);
  scenario.numerics.element = ElementType::tet4;
  scenario.material.poissons_ratio = 0;
  scenario.contact.surface = ContactSurface::facets;
  scenario.tools = {plane("left", {0, 0, 0}, {1, 0, 0}), plane("right", {2 * disc_radius, 0, 0}, {-1, 0, 0})};
  const double transit = 2 * disc_radius * std::sqrt(scenario.material.density / scenario.material.youngs_modulus);
  const double speed = approach / (30 * transit);
  scenario.stages = {driven({{.tool = 0, .velocity = {speed, 0, 0}, .direction = {1, 0, 0}},
                             {.tool = 1, .velocity = {-speed, 0, 0}, .direction = {-1, 0, 0}}},
                            33 * transit, 0.1 / transit)};
  ThreadTeam team(1);
  Simulation simulation(
      build_model(pack({disc_mesh(20)}, {2 * disc_radius, 2 * disc_radius, disc_thickness}), scenario, "test"),
      scenario, team);
  const std::vector<double> start(simulation.model().position.begin(), simulation.model().position.end());
  double force = 0, across = 0, along = 0; // sums over the last eight transits: force and strains grow together
  for (simulation.evaluate_forces(); !simulation.stage_complete(); simulation.evaluate_forces()) {
    if (simulation.state().time > 25 * transit && simulation.state().step % 50 == 0) {
      force += 0.5 * (std::abs(simulation.tools()[0].force[0]) + std::abs(simulation.tools()[1].force[0]));
      const auto strain = strain_in_middle(simulation.model(), start);
      along += strain[0], across += strain[1];
    }
    simulation.advance();
  }
  const double stress = 2 * force / (M_PI * 2 * disc_radius * disc_thickness);
  const double modulus = scenario.material.youngs_modulus;
  INFO(simulation.state().step << " steps; across " << modulus * across / stress << ", along "
                               << modulus * along / stress);
  CHECK(within(modulus * across, stress, 0.02));
  CHECK(std::abs(along / across + 3) < 0.1);
}

// --------------------------------------------------------------------------------------------------------- runs

/// The tablet sticks to the lower punch, which rubs, and for good to the plate.
std::string sticky_text() {
  const std::string weak = R"([tools.adhesion]
tensile_strength = 5
shear_strength = 4
fracture_energy = 0.002
rebond = "on_contact"
)",
                    strong = R"([tools.adhesion]
tensile_strength = 50
shear_strength = 50
fracture_energy = 0.5
)";
  const std::string text = replaced(tablet_text, "friction = 0.2\n", "friction = 0.2\n" + weak);
  return replaced(text, "face = \"+x\"\n", "face = \"+x\"\n" + strong);
}

TEST_CASE("a run with tools is bitwise the same on one, two and four threads, and when it is resumed") {
  for (const std::string& text : {tablet_text, sticky_text()}) {
    check_threads(text, 4);
    check_resuming(text, 4);
  }
}

TEST_CASE("a run with tools whose stage checkpoint was lost writes it again and ends the same") {
  const Folder folder;
  prepare(folder, 4, sticky_text());
  const auto run = [&](const std::string& output) {
    return mpfem_command(fmt::format("run {} -o {} --resume", folder / "scenario.toml", folder / output));
  };
  REQUIRE(run("whole.h5").exit_code == 0);
  REQUIRE(run("run.h5").exit_code == 0);
  // The later checkpoints count the lost one as written, so that each of them is read before an earlier one is taken.
  for (const std::string lost : {"hold", "eject"}) {
    REQUIRE(std::filesystem::remove(folder / ("run." + lost + ".checkpoint.h5")));
    const Outcome outcome = run("run.h5");
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.messages, Catch::Contains(lost + ".checkpoint.h5 is missing; the run continues from"));
    CHECK(first_difference(folder / "whole.h5", folder / "run.h5").empty());
  }
  // Half-damaged bonds to tools would pull with another stiffness.
  const Outcome stiffer =
      mpfem_command(fmt::format("run {} -o {} --from {} --set contact.stiffness_factor=50", folder / "scenario.toml",
                                folder / "stiffer.h5", folder / "run.hold.checkpoint.h5"));
  CHECK(stiffer.exit_code == 2);
  CHECK_THAT(stiffer.messages, Catch::Contains("formed with another penalty"));
}

TEST_CASE("grains that stick to tools keep the ledger, and the history tells what holds them") {
  const Folder folder;
  prepare(folder, 4, sticky_text());
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  CHECK(schema::validate(folder / "run.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const auto work = file.read(schema::run::history_external_work),
             residual = file.read(schema::run::history_energy_residual);
  const double most = *std::max_element(work.begin(), work.end());
  for (const double r : residual) CHECK(std::abs(r) < 0.01 * most);
  const auto lost = file.read(schema::run::history_tools_adhesion_dissipation, "lower"),
             area = file.read(schema::run::history_tools_bonded_area, "lower");
  CHECK(*std::max_element(area.begin(), area.end()) > 0);
  CHECK(lost.back() > 0); // the ejected tablet jumps
  CHECK(std::is_sorted(lost.begin(), lost.end()));
  CHECK_FALSE(file.has(schema::run::history_tools_bonded_area, "upper"));
}

TEST_CASE("a press keeps the ledger, and its forces and their moments balance") {
  // The upper punch, which does not rub, has its reference point 1 mm beside the axis of the die.
  constexpr double arm = 1, axis = 0.21; // mm
  const Folder folder;
  prepare(folder, 4, replaced(tablet_text, "face = \"+z\"", "point = [1.21, 0.21, 0.42]\nnormal = [0, 0, -1]"));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  CHECK(schema::validate(folder / "run.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.tools() == std::vector<std::string>{"die", "lower", "plate", "upper"});
  const auto work = file.read(schema::run::history_external_work),
             residual = file.read(schema::run::history_energy_residual);
  const double most = *std::max_element(work.begin(), work.end());
  for (const double r : residual) CHECK(std::abs(r) < 0.01 * most);
  const auto stage = file.read(schema::run::history_stage);
  const auto force = [&](const char* tool, std::size_t row) {
    return file.read(schema::run::history_tools_force, tool)[3 * row + 2];
  };
  // At the end of the hold: the lower punch and the die carry the force of the upper punch; the weight is negligible.
  const auto row = static_cast<std::size_t>(std::upper_bound(stage.begin(), stage.end(), 1) - stage.begin()) - 1;
  REQUIRE(force("upper", row) > 0.5);
  const double sum = force("upper", row) + force("lower", row) + force("die", row);
  INFO(sum << " N of " << force("upper", row));
  CHECK(std::abs(sum) < 0.02 * force("upper", row)); // the rest is vibration
  const double wall = file.read(schema::run::history_tools_normal_force, "die")[row];
  CHECK(std::abs(force("die", row)) <= 0.1 * wall * (1 + 1e-9));
  // The container's stresses are those of its tools.
  const auto lengths = file.read(schema::run::history_box_lengths),
             stress = file.read(schema::run::history_wall_stress);
  CHECK(within(lengths[3 * row], 0.58, 1e-12));
  CHECK(within(stress[6 * row + 5], force("upper", row) / (M_PI * 0.29 * 0.29), 1e-12));
  CHECK(within(stress[6 * row], wall / (M_PI * 0.58 * lengths[3 * row + 2]), 1e-12));
  // Of eight grains of ball_mesh(4, 0.1).
  CHECK(within(file.read(schema::run::history_relative_density)[row], 0.45, 1e-6));
  // Moments are about a point of a plane and the centre of the die, which move with them.
  // Means over the hold, in which the grains still vibrate.
  const auto hold = static_cast<std::size_t>(std::upper_bound(stage.begin(), stage.end(), 0) - stage.begin());
  REQUIRE(row > hold + 10);
  const auto vector = [&](const auto& dataset, const char* tool) {
    const auto values = file.read(dataset, tool);
    Vector total = Vector::Zero();
    for (std::size_t i = hold; i <= row; ++i) total += Vector(values.data() + 3 * i);
    return Vector(total / static_cast<double>(row + 1 - hold));
  };
  const double push = vector(schema::run::history_tools_force, "upper").z();
  const Vector on_upper = vector(schema::run::history_tools_moment, "upper");
  Vector moment = Vector::Zero(); // about a point of the axis
  for (const auto& [tool, point] :
       {std::pair{"upper", Vector(axis + arm, axis, 0.42)}, std::pair{"lower", Vector(axis, axis, 0)},
        std::pair{"die", Vector(axis, axis, 0.15)}}) {
    const Vector from_axis = point + vector(schema::run::history_tools_displacement, tool) - Vector(axis, axis, 0);
    moment += vector(schema::run::history_tools_moment, tool) +
              from_axis.cross(vector(schema::run::history_tools_force, tool));
  }
  CHECK(moment.norm() < 0.02 * push * 0.29); // the rest is vibration
  // Eight grains that stand nearly evenly about the axis push nearly at it.
  CHECK(within(on_upper.y(), arm * push, 0.02));
  CHECK(std::abs(on_upper.x()) < 0.02 * arm * push);
  CHECK(on_upper.z() == 0);
}

TEST_CASE("what tools do on the grains is all the work, and what rubs on tools and between grains all that is lost") {
  const Folder folder;
  prepare(folder, 4, replaced(tablet_text, "[gravity]\nacceleration = [0, 0, -1e6]\n", ""));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  namespace run = schema::run;
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const auto work = file.read(run::history_external_work), lost = file.read(run::history_friction_dissipation),
             stored = file.read(run::history_friction_energy);
  std::vector<double> of_tools(work.size()), lost_at_tools(work.size()), stored_at_tools(work.size());
  const auto add = [&](std::vector<double>& sum, const std::vector<double>& column) {
    for (std::size_t row = 0; row < sum.size(); ++row) sum[row] += column[row];
  };
  for (const std::string& tool : file.tools()) {
    add(of_tools, file.read(run::history_tools_work, tool));
    add(lost_at_tools, file.read(run::history_tools_friction_dissipation, tool));
    add(stored_at_tools, file.read(run::history_tools_friction_energy, tool));
  }
  const double most = *std::max_element(work.begin(), work.end());
  for (std::size_t row = 0; row < work.size(); ++row) {
    CHECK(std::abs(of_tools[row] - work[row]) < accumulated_rounding * most); // that leave take their part back
    CHECK(stored_at_tools[row] <= stored[row] * (1 + 1e-9));
    CHECK(lost_at_tools[row] <= lost[row] * (1 + 1e-9));
  }
  CHECK(file.read(run::history_tools_work, "die").back() < 0); // at rest, it only takes back what it stored
  // At the end of the compaction, the first snapshot.
  const auto stage = file.read(run::history_stage);
  const auto row = static_cast<std::size_t>(std::upper_bound(stage.begin(), stage.end(), 0) - stage.begin()) - 1;
  double lost_by_pairs = 0, stored_by_pairs = 0;
  for (const double x : file.read(run::snapshots_pair_friction_dissipation, "0000")) lost_by_pairs += x;
  for (const double x : file.read(run::snapshots_pair_friction_energy, "0000")) stored_by_pairs += x;
  REQUIRE(lost_by_pairs > 0);
  CHECK(within(stored_by_pairs + stored_at_tools[row], stored[row], 1e-9));
  CHECK(lost_by_pairs + lost_at_tools[row] < lost[row] * (1 + 1e-9));
  CHECK(within(lost_by_pairs + lost_at_tools[row], lost[row], 0.02)); // of pairs that have parted
}

TEST_CASE("a die that floats bears no axial force, and a stage's travel is that of its punch, not of the servo") {
  const Folder folder;
  const auto forces = [&](const std::string& die) {
    std::string text = replaced(tablet_text, "[gravity]\nacceleration = [0, 0, -1e6]\n", "");
    text = text.substr(0, text.find("[[stages]]")) + R"([[stages]]
name = "press"
type = "tools"
away = ["plate"]
travel = 0.24
drive.upper.speed = 4000
damping_rate = 1e6
damping_fade_stress = 1e3
)" + die;
    prepare(folder, 4, text);
    const Outcome outcome =
        mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
    INFO(outcome.messages);
    REQUIRE(outcome.exit_code == 0);
    const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
    const auto along = [&](const auto& dataset, const char* tool) { return file.read(dataset, tool).back(); };
    CHECK(within(along(schema::run::history_tools_displacement, "upper"), -0.24, 1e-9));
    return std::array{along(schema::run::history_tools_force, "upper"),
                      along(schema::run::history_tools_force, "lower"), along(schema::run::history_tools_force, "die")};
  };
  const auto fixed = forces(""), floating = forces("drive.die = { force = 0, servo_speed = 40000 }\n");
  REQUIRE(fixed[0] > 1);                           // N
  CHECK(fixed[2] < -0.02 * fixed[0]);              // it drags the die along
  CHECK(std::abs(floating[2]) < 0.005 * fixed[0]); // the rest is vibration
  CHECK(within(-floating[1], floating[0], 0.02));
}

TEST_CASE("a punch holds a stress over the section of its die, and no other tool does") {
  const Folder folder;
  const auto run = [&](const std::string& hold) {
    prepare(folder, 4,
            replaced(tablet_text.substr(0, tablet_text.find("[[stages]]\nname = \"unload\"")), "duration = 1e-6\n",
                     "duration = 2e-5\ndamping_rate = 1e6\ndamping_fade_stress = 1e3\n" + hold));
    return mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
  };
  const Outcome held = run("drive.upper = { stress = 6, servo_speed = 5000 }\n");
  INFO(held.messages);
  REQUIRE(held.exit_code == 0);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(within(file.read(schema::run::history_tools_force, "upper").back(), 6 * M_PI * 0.29 * 0.29, 0.02));
  CHECK(within(file.read(schema::run::history_wall_stress).back(), 6, 0.02));
  const Outcome die = run("drive.die = { stress = 6, servo_speed = 5000 }\n");
  CHECK(die.exit_code == 2);
  CHECK_THAT(die.messages, Catch::Contains("punches of [container]"));
  const Outcome both = run("drive.upper = { stress = 6, force = 1, servo_speed = 5000 }\n");
  CHECK(both.exit_code == 2);
  CHECK_THAT(both.messages, Catch::Contains("speed, velocity, force and stress"));
  const Outcome travel = run("travel = 0.1\ndrive.upper = { stress = 6, servo_speed = 5000 }\n");
  CHECK(travel.exit_code == 2);
  CHECK_THAT(travel.messages, Catch::Contains("speed or velocity"));
}

TEST_CASE("a run file has the surfaces of its tools as the scenario has them, and where they stand in each snapshot") {
  namespace run = schema::run;
  const Folder folder;
  prepare(folder, 3, tablet_text);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.members(run::tools_shape) == std::vector<std::string>{"die", "lower", "plate", "upper"});
  CHECK(file.read_scalar(run::tools_shape, "die") == "cylinder");
  CHECK(file.read_scalar(run::tools_inside, "die") == 1);
  CHECK(file.read_scalar(run::tools_radius, "die") == 0.29);
  CHECK(file.read_scalar(run::tools_half_length, "die") == 0.25);
  CHECK(file.read_scalar(run::tools_rounding, "die") == 0.03);
  CHECK(file.read(run::tools_direction, "die") == std::vector<double>{0, 0, 1});
  CHECK(within(file.read(run::tools_point, "die")[2], 0.15, 1e-12));
  CHECK(file.read_scalar(run::tools_shape, "plate") == "plane");
  CHECK(file.read(run::tools_direction, "plate") == std::vector<double>{-1, 0, 0});
  // Each stage ends with a snapshot and a row; whatever is withdrawn then is not in place.
  using Names = std::vector<std::string>;
  const Names last = file.read(run::snapshots_tool_name, file.snapshots().back());
  CHECK(last == Names{"lower", "plate"});
  CHECK(file.read(run::snapshots_tool_name, file.snapshots().front()) == Names{"die", "lower", "upper"});
  const auto displacement = file.read(run::snapshots_tool_displacement, file.snapshots().back());
  const auto lower = file.read(run::history_tools_displacement, "lower");
  const auto plate = file.read(run::history_tools_displacement, "plate");
  CHECK(std::vector(displacement.begin(), displacement.begin() + 3) == std::vector(lower.end() - 3, lower.end()));
  CHECK(std::vector(displacement.begin() + 3, displacement.end()) == std::vector(plate.end() - 3, plate.end()));
}

TEST_CASE("spheres, cones, endless cylinders and triangles are written with all that makes them") {
  namespace run = schema::run;
  const Folder folder;
  write_text(folder / "slab.stl", slab_stl({0, 0, 0.1}, {1, 1, 0.4}));
  Scenario scenario = holding_scenario(1);
  scenario.tools = {{"ball", SphereShape{{0.1, 0.2, 0.3}, 0.05, true}, 0},
                    {"funnel", ConeShape{1, -1, {0.5, 0.9, 0.5}, 0.4, true}, 0},
                    {"roller", CylinderShape{0, std::array{0.5, 0.5, 2.0}, 0.7, false, {}, 0}, 0},
                    {"slab", StlShape{folder / "slab.stl", 1000, false, {}}, 0}};
  GrainMesh ball = ball_mesh(4, 0.1);
  move(ball, {0.5, 0.5, 0.6});
  const Model model = build_model(pack({ball}, {1, 1, 1}), scenario, "test");
  {
    schema::FileWriter writer(folder / "tools.h5", schema::FileKind::run, "mpfem tests");
    write_tool_geometry(writer, make_tools(scenario, model));
    writer.commit();
  }
  const schema::FileReader file(folder / "tools.h5", schema::FileKind::run);
  CHECK(file.read_scalar(run::tools_inside, "ball") == 1);
  CHECK(file.read_scalar(run::tools_radius, "ball") == 0.05);
  CHECK(file.read(run::tools_point, "ball") == std::vector<double>{0.1, 0.2, 0.3});
  CHECK(within(file.read_scalar(run::tools_half_angle, "funnel"), 0.4, 1e-14));
  CHECK(file.read(run::tools_direction, "funnel") == std::vector<double>{0, -1, 0});
  CHECK(file.read_scalar(run::tools_inside, "roller") == 0);
  CHECK_FALSE(file.has(run::tools_half_length, "roller"));
  CHECK(file.rows(run::tools_vertex, "slab") == 8);
  CHECK(file.rows(run::tools_triangle, "slab") == 12);
  const auto vertex = file.read(run::tools_vertex, "slab");
  CHECK(*std::max_element(vertex.begin(), vertex.end()) == Approx(1).epsilon(1e-12)); // mm, of a file in metres
}

TEST_CASE("tools a thousand times too large or too far are warned of with their size and the packing's, others not") {
  Scenario scenario = holding_scenario(1);
  GrainMesh ball = ball_mesh(4, 0.1);
  move(ball, {0.5, 0.5, 0.6});
  const Model model = build_model(pack({ball}, {1, 1, 2}), scenario, "test");
  const auto warnings = [&](const ToolShape& shape) {
    scenario.tools = {{"tool", shape, 0}};
    return implausible_sizes(scenario, model, make_tools(scenario, model));
  };
  const std::string box = "mm away from the packing, whose box is only 1 x 1 x 2 mm (lengths are in mm)";
  for (const double unit : {1.0, 1000.0}) {
    const CylinderShape die{.radius = 0.8 * unit};
    const SphereShape hollow{.centre = {0.5, 0.5, 1}, .radius = 1.3 * unit, .inside = true};
    const PlaneShape punch{.point = {0, 0, 2 * unit}, .normal = {0, 0, -1}};
    CAPTURE(unit);
    for (const ToolShape& shape : {ToolShape(die), ToolShape(hollow), ToolShape(punch)})
      CHECK(warnings(shape).size() == (unit == 1 ? 0 : 1));
    if (unit == 1) continue;
    // From the wall to the box's edges along z, which are sqrt(0.5) mm from the axis.
    CHECK(warnings(die).front() == "tool 'tool' (cylinder with radius = 800 mm) is 799.3 " + box);
    CHECK(warnings(punch).front() == "tool 'tool' (plane) is 1998 " + box);
  }
  // A wall about the packing is warned of where the packing fills less than 1 % of it.
  CHECK(warnings(CylinderShape{.radius = 12}).empty());
  CHECK(warnings(CylinderShape{.radius = 80}).front() == "tool 'tool' (cylinder with radius = 80 mm) is 79.29 " + box);
  CHECK(warnings(SphereShape{.centre = {0.5, 0.5, 1}, .radius = 80, .inside = true}).size() == 1);
  // Curved punches may be nearly flat, and a tool may come from afar.
  CHECK(warnings(SphereShape{.centre = {0.5, 0.5, 1002}, .radius = 1000}).empty());
  CHECK(warnings(PlaneShape{.point = {0, 0, 20}, .normal = {0, 0, -1}}).empty());
}

TEST_CASE("check and run warn of a die whose radius is not in mm") {
  const Folder folder;
  const std::string pressing = tablet_text.substr(0, tablet_text.find("[[stages]]"));
  prepare(folder, 3, replaced(pressing, "radius = 0.29", "radius = 290") + R"([[stages]]
type = "tools"
away = ["plate"]
duration = 1e-7
)");
  const std::string warning = "tool 'die' (cylinder with radius = 290 mm) is 289";
  const Outcome check = mpfem_command(fmt::format("check {} --quiet", folder / "scenario.toml"));
  INFO(check.messages);
  CHECK(check.exit_code == 0);
  CHECK_THAT(check.output, Catch::Contains(warning));
  const Outcome run = mpfem_command(fmt::format("run {} -o {}", folder / "scenario.toml", folder / "run.h5"));
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.messages, Catch::Contains("mpfem: warning: " + warning));
}

TEST_CASE("a branch continues with the tools in place, may add further ones, and refuses other tools") {
  const Folder folder;
  prepare(folder, 3, tablet_text);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const std::string from = folder / "run.hold.checkpoint.h5";
  const auto branch = [&](const std::string& text) {
    write_text(folder / "branch.toml", text);
    return mpfem_command(
        fmt::format("run {} -o {} --quiet --from {}", folder / "branch.toml", folder / "branch.h5", from));
  };
  const std::string unloading = tablet_text.substr(0, tablet_text.find("[[stages]]")) +
                                tablet_text.substr(tablet_text.find("[[stages]]\nname = \"unload\""));
  const Outcome good = branch(replaced(unloading, "friction = 0.2", "friction = 0.4"));
  INFO(good.messages);
  CHECK(good.exit_code == 0);
  // A new tool is in place from the branch's first stage on, unless that stage leaves it out.
  const std::string with_pin = replaced(unloading, "[container]\nwall", R"([[tools]]
name = "pin"
type = "sphere"
centre = [0.3, 0.3, 1]
radius = 0.2
[container]
wall)");
  const Outcome further = branch(with_pin);
  INFO(further.messages);
  CHECK(further.exit_code == 0);
  const schema::FileReader file(folder / "branch.h5", schema::FileKind::run);
  CHECK(file.has(schema::run::history_tools_work, "pin"));
  const auto refusal = [&](const std::string& text) {
    const Outcome outcome = branch(text);
    CHECK(outcome.exit_code == 2);
    return outcome.messages;
  };
  CHECK_THAT(refusal(replaced(with_pin, "centre = [0.3, 0.3, 1]", "centre = [0.3, 0.3, 0.3]")),
             Catch::Contains("tool 'pin'") && Catch::Contains("inside grains"));
  CHECK_THAT(refusal(replaced(unloading, "radius = 0.29", "radius = 0.3")),
             Catch::Contains("branch.toml:") && Catch::Contains("key 'tools.0.type'") && Catch::Contains("'die'"));
  const std::size_t pin = with_pin.find("[[tools]]\nname = \"pin\""), after_pin = with_pin.find("[container]");
  const std::string pin_first = with_pin.substr(0, with_pin.find("[[tools]]")) + with_pin.substr(pin, after_pin - pin) +
                                unloading.substr(unloading.find("[[tools]]"));
  CHECK_THAT(refusal(pin_first), Catch::Contains("key 'tools.0.name': found 'pin', allowed: 'die'"));
  CHECK_THAT(refusal(replaced(unloading, "upper = \"upper\"",
                              "upper = \"top\"\n[[tools]]\nname = \"top\"\n"
                              "type = \"plane\"\nface = \"+z\"")),
             Catch::Contains("[container] differs"));
  CHECK_THAT(refusal(replaced(unloading, "friction = 0.2\n", R"(friction = 0.2
[tools.adhesion]
tensile_strength = 5
shear_strength = 4
fracture_energy = 0.01
)")),
             Catch::Contains("key 'tools.1.adhesion'"));
}

namespace {

/// A slab from an STL file beside the scenario, which stands still.
const std::string slab_text = material_text + R"([[tools]]
name = "slab"
type = "stl"
file = "slab.stl"
scale = 1000.0
friction = 0.1
[[stages]]
name = "hold"
type = "tools"
duration = 2e-6
)";

} // namespace

TEST_CASE("a branch and a resumed run have the STL surface of the run before, wherever its file is") {
  const Folder folder;
  write_text(folder / "slab.stl", slab_stl({0, 0, -0.4}, {1, 1, -0.1}));
  prepare(folder, 3, slab_text);
  const auto run = [&](const std::string& options) {
    return mpfem_command(fmt::format("run {} --quiet {}", folder / "scenario.toml", options));
  };
  std::filesystem::create_directory(folder / "out");
  const Outcome first = run(fmt::format("-o {}", folder / "out/run.h5"));
  INFO(first.messages);
  REQUIRE(first.exit_code == 0);
  const std::string branch =
      fmt::format("-o {} --from {}", folder / "branch.h5", folder / "out/run.hold.checkpoint.h5");
  const Outcome same = run(branch);
  INFO(same.messages);
  CHECK(same.exit_code == 0);
  const std::string again = fmt::format("-o {}", folder / "again.h5");
  REQUIRE(run(again + " --time-limit 1e-9").exit_code == 5);
  write_text(folder / "slab.stl", slab_stl({0, 0, -0.4}, {1, 1, -0.2}));
  std::filesystem::remove(folder / "branch.h5");
  for (const std::string& options : {branch, again + " --resume"}) {
    const Outcome changed = run(options);
    CHECK(changed.exit_code == 2);
    CHECK_THAT(changed.messages, Catch::Contains("tool 'slab': its STL file is another one"));
  }
}

TEST_CASE("a run does not replace the STL file of a tool, nor write a checkpoint over what it reads") {
  const Folder folder;
  prepare(folder, 3, slab_text);
  for (const std::string name : {"slab.stl", "run.checkpoint.h5"}) {
    std::filesystem::remove(folder / "slab.stl");
    write_text(folder / name, slab_stl({0, 0, -0.4}, {1, 1, -0.1}));
    const std::string output = name == "slab.stl" ? folder / name : folder / "run.h5",
                      before = read_text(folder / name);
    const Outcome refused = mpfem_command(
        fmt::format("run {} --quiet -o {} --set tools.0.file={}", folder / "scenario.toml", output, name));
    INFO(refused.messages);
    CHECK(refused.exit_code == 2);
    CHECK(refused.one_error_line("mpfem"));
    CHECK_THAT(refused.messages, Catch::Contains("would overwrite the input"));
    CHECK(read_text(folder / name) == before);
  }
}

TEST_CASE("a run warns of a tool that it drives and that touches no grain, whatever its shape") {
  const Folder folder;
  write_text(folder / "slab.stl", slab_stl({0, 0, -0.4}, {1, 1, -0.1}));
  prepare(folder, 3, slab_text + "drive.slab.velocity = [0, 0, -1000]\n");
  const std::string run = fmt::format("run {} -o {}", folder / "scenario.toml", folder / "run.h5");
  CHECK_THAT(mpfem_command(run).messages, Catch::Contains("warning: the tool 'slab' was driven and touched no grain"));
  // Towards the grains it meets them.
  const Outcome meets = mpfem_command(run + " --set stages.0.drive.slab.velocity=[0,0,75000]");
  INFO(meets.messages);
  CHECK(meets.exit_code == 0);
  CHECK_THAT(meets.messages, !Catch::Contains("touched no grain"));
}

TEST_CASE("in stages that move walls all tools are in place") {
  const Folder folder;
  prepare(folder, 3, scenario_text);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const auto branch = [&](double z) {
    write_text(folder / "branch.toml", scenario_text + fmt::format(R"([[tools]]
name = "ball"
type = "sphere"
centre = [0.3, 0.3, {}]
radius = 0.2
)",
                                                                   z));
    return mpfem_command(fmt::format("run {} -o {} --quiet --from {} --set stages.0.relative_density=0.63",
                                     folder / "branch.toml", folder / "branch.h5",
                                     folder / "run.compaction.checkpoint.h5"));
  };
  CHECK(branch(9).exit_code == 0);
  const Outcome inside = branch(0.3);
  CHECK(inside.exit_code == 2);
  CHECK_THAT(inside.messages, Catch::Contains("tool 'ball' would stand") && Catch::Contains("inside grains"));
}

TEST_CASE("mistakes in tools are refused with the key and what is allowed") {
  const Folder folder;
  const auto refusal = [&](const std::string& from, const std::string& to) {
    prepare(folder, 3, replaced(tablet_text, from, to));
    const Outcome outcome =
        mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
    CHECK(outcome.exit_code == 2);
    return outcome.messages;
  };
  CHECK_THAT(refusal("name = \"lower\"", "name = \"die\""), Catch::Contains("the name of an earlier tool"));
  CHECK_THAT(refusal("wall = \"die\"", "wall = \"lower\""), Catch::Contains("allowed: a cylinder along z"));
  CHECK_THAT(refusal("upper = \"upper\"", "upper = \"lower\""), Catch::Contains("normal is [0, 0, -1]"));
  CHECK_THAT(refusal("watch = \"upper\"", "watch = \"uper\""), Catch::Contains("one of die, lower, upper, plate"));
  CHECK_THAT(refusal("drive.plate.speed = 10000", "drive.plate.velocity = [1, 2]"), Catch::Contains("velocity"));
  CHECK_THAT(refusal("away = [\"plate\"]\nforce = 0\nwatch = \"upper\"\ndrive.upper.speed = -10000",
                     "away = [\"plate\"]\nforce = 0\nwatch = \"plate\"\ndrive.upper.speed = -10000"),
             Catch::Contains("key 'stages.2.watch': found 'plate', which is away"));
  const auto driven_so = [&](const std::string& keys) {
    return refusal("drive.plate.speed = 10000", "drive.plate = { " + keys + " }");
  };
  CHECK_THAT(refusal("drive.plate.speed = 10000", "drive.plate.speed = 10000\nforces_reached = true"),
             Catch::Contains("forces_reached") && Catch::Contains("no tool that holds a force or stress"));
  CHECK_THAT(driven_so("speed = 1, directon = [1, 0, 0]"), Catch::Contains("did you mean 'direction'?"));
  CHECK_THAT(driven_so("speed = 1, direction = [1, 0, 0]"), Catch::Contains("moves along its normal"));
  CHECK_THAT(refusal("drive.lower.velocity = [0, 0, 20000]", "drive.lower.speed = 20000\n"
                                                             "drive.die = { speed = 1, direction = [0, 0, 0] }"),
             Catch::Contains("length 0"));
  CHECK_THAT(refusal("drive.lower.velocity = [0, 0, 20000]",
                     "drive.lower.speed = 20000\n"
                     "drive.die = { velocity = [1, 0, 0], direction = [1, 0, 0] }"),
             Catch::Contains("only with 'speed' or 'force'"));
  CHECK_THAT(refusal("away = [\"plate\"]\nrelative", "away = [\"plate\", \"upper\"]\nrelative"),
             Catch::Contains("which the stage also drives"));
  CHECK_THAT(refusal("radius = 0.29", "radius = 0.2"), Catch::Contains("into the tool 'die'"));
  CHECK_THAT(refusal("rounding = 0.03", "rounding = 0.3"), Catch::Contains("half of the extent"));
  CHECK_THAT(refusal("travel = 0.05\n", ""), Catch::Contains("without an end"));
  const auto adhesion = [&](const std::string& keys) {
    return refusal("friction = 0.2\n",
                   "friction = 0.2\n[tools.adhesion]\ntensile_strength = 5\nshear_strength = 4\n" + keys);
  };
  CHECK_THAT(adhesion(""), Catch::Contains("fracture_energy"));
  CHECK_THAT(adhesion("fracture_energy = 1e-9\n"), Catch::Contains("tool 'lower': adhesion key 'fracture_energy'"));
  CHECK_THAT(adhesion("fracture_energy = 0.01\nnormal_only = true\n"), Catch::Contains("normal_only"));
  CHECK_THAT(adhesion("fracture_energy = 0.01\nstiffness_factor = 20\n"),
             Catch::Contains("allowed: with friction up to"));
  CHECK_THAT(adhesion("fracture_energy = 0.01\nstiffness = 1e9\n"), Catch::Contains("smallest penalty"));
  CHECK_THAT(refusal("[gravity]\nacceleration = [0, 0, -1e6]", "walls = true\n[gravity]\nacceleration = [0, 0, -1]"),
             Catch::Contains("walls"));
}
