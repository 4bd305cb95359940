#pragma once
// A column of elastic matter that a punch presses against another in a rigid die, all of whose wall slides: from the
// upper to the lower punch the stress falls by exp(-4 mu K H/D), K = nu/(1 - nu) (Janssen 1895). Reference: finite
// elements with smooth punches, tests/reference/die_transmission.csv.

#include <array>
#include <cmath>
#include <cstdint>

#include "solver/run/simulation.hpp"
#include "tests/support/driven_tools.hpp"
#include "tests/support/meshes.hpp"

namespace mpfem::test::die_column {

constexpr double column_radius = 0.5, column_height = 1; // mm

/// A quarter of a cylinder about z, x > 0 and y > 0, of n cells along the radius and `layers` along the axis: the
/// square's shells mapped to circles.
inline GrainMesh quarter_cylinder(int n, int layers, double radius, double height) {
  GrainMesh mesh = block_mesh({n, n, layers});
  for (auto& x : mesh.node) {
    const double u = 0.5 * (x[0] + 1), v = 0.5 * (x[1] + 1), shell = std::max(u, v);
    const double angle = shell > 0 ? M_PI / 4 * (v > u ? 2 - u / v : v / u) : 0;
    x = {radius * shell * std::cos(angle), radius * shell * std::sin(angle), 0.5 * height * x[2]};
  }
  return mesh;
}

/// What is varied.
struct Settings {
  int n = 12; ///< cells along the radius, and along the axis
  ElementType element = ElementType::tet4;
  bool both_ends = false; ///< each punch moves half of the way
  double penalty = 30;    ///< stiffness factor: under its own stress the wall gives by 1/300 of an element
};

/// Places of the tools in the scene.
constexpr std::size_t die = 0, lower = 1, upper = 2;
/// s, of a wave along a bar as long as the column.
inline const double transit = column_height * std::sqrt(1.55e-9 / 5000);

/// The die, which rubs, smooth punches at both ends and planes of symmetry; no stages.
inline Scenario scene(const Settings& settings, double nu, double mu) {
  Scenario scenario = holding_scenario(1);
  scenario.numerics.element = settings.element;
  scenario.numerics.own_pressure = usual_own_pressure(settings.element);
  scenario.material.poissons_ratio = nu;
  scenario.contact.stiffness_factor = settings.penalty;
  scenario.contact.surface = ContactSurface::facets;
  const CylinderShape bore{2, std::array{0.0, 0.0, 0.5}, column_radius * (1 + 1e-9), true, {}, 0};
  scenario.tools = {{.name = "die", .shape = bore, .friction = mu},
                    plane("lower", {0, 0, 0}, {0, 0, 1}),
                    plane("upper", {0, 0, column_height}, {0, 0, -1}),
                    plane("symmetry-x", {0, 0, 0}, {1, 0, 0}),
                    plane("symmetry-y", {0, 0, 0}, {0, 1, 0})};
  return scenario;
}

/// The column, wider than the die by a share of its radius.
inline MeshedPacking column(const Settings& settings, double wider = 0) {
  GrainMesh mesh = quarter_cylinder(settings.n, settings.n, column_radius * (1 + wider), column_height);
  move(mesh, {0, 0, 0.5 * column_height});
  return pack({mesh}, {column_radius, column_radius, column_height});
}

/// mm^2, section of the meshed quarter: triangles over 2 n chords of its arc. A pressure p on these chords gives nodes
/// radial forces of p (2/R) times the section and the height in all: chord times cos(half angle) is R sin(angle).
inline double section(int n) {
  const double angle = M_PI / 4 / n;
  return n * column_radius * column_radius * std::sin(angle);
}
/// MPa, of a normal force (N) on the die over a height (mm).
inline double wall_stress(int n, double normal_force, double height) {
  return normal_force * column_radius / (2 * section(n) * height);
}

struct Pressed {
  double transmission = 0;  ///< force of the lower punch over that of the upper
  double upper_force = 0;   ///< N
  double die_force = 0;     ///< N, along the axis, of the column on the die
  double approach = 0;      ///< mm, of the punches to each other at the end
  double lost_at_tools = 0; ///< mJ, friction's dissipation, tool by tool
  HistoryRow row{};         ///< the last
  std::int64_t steps = 0;
};

/// Presses by 0.2 % in 33 transits of waves; forces are means of the last eight.
inline Pressed press(const Settings& settings, double nu, double mu) {
  constexpr double strain = 2e-3;
  Scenario scenario = scene(settings, nu, mu);
  const double speed = strain * column_height / (30 * transit) * (settings.both_ends ? 0.5 : 1);
  std::vector<ToolDrive> drives = {{.tool = upper, .velocity = {0, 0, -speed}, .direction = {0, 0, -1}}};
  if (settings.both_ends) drives.push_back({.tool = lower, .velocity = {0, 0, speed}, .direction = {0, 0, 1}});
  scenario.stages = {driven(drives, 33 * transit)};
  ThreadTeam team(1);
  Simulation simulation(build_model(column(settings), scenario, "test"), scenario, team);
  Pressed pressed;
  double low = 0, high = 0, wall = 0, levels = 0;
  for (simulation.evaluate_forces(); !simulation.stage_complete(); simulation.evaluate_forces()) {
    if (simulation.state().time > 25 * transit) {
      low -= simulation.tools()[lower].force[2], high += simulation.tools()[upper].force[2];
      wall += simulation.tools()[die].force[2], levels += 1;
    }
    simulation.advance();
  }
  pressed.transmission = low / high;
  pressed.upper_force = high / levels;
  pressed.die_force = wall / levels;
  pressed.approach = simulation.tools()[lower].moved[2] - simulation.tools()[upper].moved[2];
  pressed.row = simulation.observe();
  pressed.steps = simulation.state().step;
  for (std::size_t tool = 0; tool < simulation.tools().size(); ++tool)
    pressed.lost_at_tools += simulation.tools()[tool].friction_dissipation;
  return pressed;
}

} // namespace mpfem::test::die_column
