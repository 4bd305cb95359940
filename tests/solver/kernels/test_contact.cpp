// Contact between grains and with walls.

#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/physics/gap.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

struct Totals {
  std::array<double, 3> momentum{}, angular{};
};

Totals totals(const Model& m) {
  Totals t;
  for (std::size_t n = 0; n < static_cast<std::size_t>(m.nodes()); ++n) {
    const double *x = &m.position[4 * n], *v = &m.velocity[4 * n];
    const double mass = 1 / m.inverse_mass[n];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      t.momentum[a] += mass * v[a];
      t.angular[a] += mass * (x[b] * v[c] - x[c] * v[b]);
    }
  }
  return t;
}

} // namespace

TEST_CASE("the closest point of a triangle is the closest of a fine sampling") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random_point = [&] { return Vector3<double>{uniform(random), uniform(random), uniform(random)}; };
  for (int i = 0; i < 300; ++i) {
    const Vector3<double> x[3] = {random_point(), random_point(), random_point()};
    const Vector3<double> p = 1.5 * random_point();
    const ClosestPoint<double> found = closest_point_on_triangle(p, x);
    const double distance = norm(p - found.point);
    double sampled = 1e9;
    const int n = 150;
    for (int a = 0; a <= n; ++a)
      for (int b = 0; a + b <= n; ++b)
        sampled = std::min(sampled, norm(p - (x[0] + double(a) / n * (x[1] - x[0]) + double(b) / n * (x[2] - x[0]))));
    CHECK(distance <= sampled + rounding);
    CHECK(distance > sampled - 3.0 / n); // a sample lies within that distance of the closest point
    CHECK(found.weight1 >= 0);
    CHECK(found.weight2 >= 0);
    CHECK(found.weight1 + found.weight2 <= 1 + rounding);
  }
}

TEST_CASE("the gap is continuous as a node slides inside over the edge of two facets") {
  // A ridge: two facets that meet at 30 degrees. The path crosses below it.
  const double slope = std::tan(M_PI / 12);
  const Vector3<double> a{0, 0, 0}, b{0, 1, 0}, c{1, 0.5, -slope}, d{-1, 0.5, -slope};
  const Vector3<double> right[3] = {a, c, b}, left[3] = {a, b, d};
  double last = -1;
  for (int i = -1000; i <= 1000; ++i) {
    const Vector3<double> p{1e-4 * i, 0.5, -0.05};
    const double gap = std::min(norm(p - closest_point_on_triangle(p, right).point),
                                norm(p - closest_point_on_triangle(p, left).point));
    if (last > 0) CHECK(std::abs(gap - last) <= 1.0001e-4); // the distance to a set has slope at most one
    last = gap;
  }
}

TEST_CASE("an oblique collision of two elastic grains keeps momentum, angular momentum and energy") {
  GrainMesh first = ball_mesh(6, 0.1), second = ball_mesh(5, 0.08);
  rotate(first, {0, 0, 1}, 0.3);
  rotate(second, {1, 0, 0}, 1.1);
  move(first, {0.5, 0.5, 0.5});
  move(second, {0.5 + 0.183, 0.5 + 0.04, 0.5});
  Scenario scenario = holding_scenario(4e-6);
  scenario.contact.surface = GENERATE(ContactSurface::facets, ContactSurface::smooth, ContactSurface::automatic);
  scenario.grain_velocity = {{5e3, 0, 0}, {-5e3, 0, 1e3}}; // 5 m/s each
  scenario.numerics.bulk_viscosity_linear = 0;
  scenario.numerics.bulk_viscosity_quadratic = 0;
  scenario.numerics.step_estimate = StepEstimateMethod::tet; // whose steps the errors of second order below belong to
  ThreadTeam team(1);
  MeshedPacking packing = pack({first, second}, {1, 1, 1});
  if (scenario.contact.surface == ContactSurface::automatic) { // one of each kind: only the first is known as a sphere
    const double volume = build_model(packing, scenario, "test").reference_volume[0];
    packing.sphere_center = {0.5, 0.5, 0.5, 0, 0, 0};
    packing.sphere_radius = {std::cbrt(volume * 3 / (4 * M_PI)), 0.08};
  }
  Simulation simulation(build_model(packing, scenario, "test"), scenario, team);
  CHECK(simulation.model().smooth_grains == (scenario.contact.surface == ContactSurface::facets   ? 0
                                             : scenario.contact.surface == ContactSurface::smooth ? 2
                                                                                                  : 1));
  const Totals start = totals(simulation.model());
  const double initial = simulation.energies().initial;
  double worst = 0, largest_contact = 0;
  while (!simulation.stage_complete()) {
    simulation.evaluate_forces();
    const HistoryRow row = simulation.observe();
    worst = std::max(worst, std::abs(row.energy_residual));
    largest_contact = std::max(largest_contact, row.contact_energy);
    simulation.advance();
  }
  const Totals end = totals(simulation.model());
  REQUIRE(largest_contact > 1e-4 * initial); // they really met
  // Separated again: the second grain was thrown back.
  simulation.evaluate_forces();
  CHECK(simulation.observe().contact_energy == 0);
  double scale = 0, angular_scale = 0;
  for (std::size_t a = 0; a < 3; ++a) scale += std::abs(start.momentum[a]) + simulation.model().mass[0] * 5e3;
  angular_scale = scale * 0.5;
  for (std::size_t a = 0; a < 3; ++a) {
    CHECK(std::abs(end.momentum[a] - start.momentum[a]) < accumulated_rounding * scale);
    CHECK(std::abs(end.angular[a] - start.angular[a]) < 1e-7 * angular_scale);
  }
  // Once apart, what is left is the error of time integration, second order of the step. In contact the ledger takes
  // the penalty energy at the step and the kinetic energy as a mean of half steps: good to 0.1 %, and it cancels.
  CHECK(std::abs(simulation.observe().energy_residual) < 2e-5 * initial);
  CHECK(worst < 2e-3 * initial);
}

TEST_CASE("a node too deep inside another grain ends the run, and the first grain that has one is named") {
  // Two pairs collide at the same speed. The second, ahead by less than the motion of one step, is deeper, and first
  // in space.
  std::vector<GrainMesh> grains(4, ball_mesh(5, 0.1));
  move(grains[0], {0.6, 0.6, 0.6}), move(grains[1], {0.81, 0.6, 0.6});
  move(grains[2], {0.1, 0.2, 0.2}), move(grains[3], {0.31 - 1e-7, 0.2, 0.2});
  Scenario scenario = holding_scenario(1e-4);
  scenario.contact.stiffness_factor = 1e-3; // hardly resists
  scenario.grain_velocity = {{0, 0, 0}, {-2e4, 0, 0}, {0, 0, 0}, {-2e4, 0, 0}};
  ThreadTeam team(GENERATE(1, 2));
  Simulation simulation(build_model(pack(grains, {1, 1, 1}), scenario, "test"), scenario, team);
  std::string message;
  double deepest_before = 0, motion = 0;
  while (message.empty() && !simulation.stage_complete()) try {
      simulation.evaluate_forces();
      deepest_before = simulation.observe().max_penetration * simulation.model().element_size[0];
      simulation.advance();
      motion = 2e4 * simulation.state().last_step;
    } catch (const SimulationError& error) {
      message = error.what();
    }
  CHECK_THAT(message, Catch::StartsWith(fmt::format("step {}, ", simulation.state().step)));
  CHECK_THAT(message,
             Catch::Contains(": a node of grain 0 is ") && Catch::Contains(" mm inside grain 1, allowed: up to"));
  // It ends with the first step that goes too far. Nodes move a little faster than their grain, since it deforms.
  const double allowed = largest_contact_depth(simulation.contact());
  CHECK(motion > 1e-7);
  CHECK(deepest_before <= allowed);
  CHECK(deepest_before > allowed - 2 * motion);
}
