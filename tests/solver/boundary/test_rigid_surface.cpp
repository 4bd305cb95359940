// Grains against rigid surfaces: planes, and one that is curved.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/boundary/plane.hpp"
#include "solver/boundary/tool_surfaces.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// A cylinder around the grains, its axis along z through (0.5, 0.5).
CylinderSurface bore(double radius) {
  return {2, {0.5, 0.5, 0.5}, radius, true, std::numeric_limits<double>::infinity(), 0};
}

/// A ball of radius 0.4 mm in the middle of the unit box.
Model ball_in_the_middle(ContactSurface surface) {
  GrainMesh ball = ball_mesh(6, 0.4);
  move(ball, {0.5, 0.5, 0.5});
  Scenario scenario = holding_scenario(1e-9);
  scenario.contact.surface = surface;
  return build_model(pack({ball}, {1, 1, 1}), scenario, "test");
}

constexpr Bounds of_ball{{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}};

template <RigidSurface Surface>
double stored_energy(Model& model, const Surface& surface) {
  double energy = 0;
  add_surface_forces(model, surface, of_ball, 0, [&](const SurfacePush& push) { energy += push.energy; });
  return energy;
}

/// Holds model.force to minus the gradient of the stored energy, by central differences at every node that is pushed.
template <RigidSurface Surface>
void check_forces(Model model, const Surface& surface) {
  std::fill(model.force.begin(), model.force.end(), 0.0);
  const double energy = stored_energy(model, surface);
  REQUIRE(energy > 0);
  const auto forces = model.force;
  constexpr double shift = 1e-7; // mm, of a penetration of 0.04
  int pushed = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (std::abs(forces[i]) < 1e-3) continue;
    ++pushed;
    const double x = model.position[i];
    model.position[i] = x + shift;
    const double above = stored_energy(model, surface);
    model.position[i] = x - shift;
    const double below = stored_energy(model, surface);
    model.position[i] = x;
    // Differences of energies lose eight digits; the curvature of the cylinder adds (shift / radius)^2.
    CHECK(within(forces[i], (below - above) / (2 * shift), 1e-6));
  }
  CHECK(pushed > 4);
}

} // namespace

TEST_CASE("forces of a rigid surface are the gradient of what it stores, on facets and on smooth surfaces") {
  for (const ContactSurface surface : {ContactSurface::facets, ContactSurface::smooth}) {
    const Model model = ball_in_the_middle(surface);
    check_forces(model, Plane{{0, 1.0}, 0.14});
    check_forces(model, Plane{{2, -1.0}, 0.86});
    check_forces(model, bore(0.38));
  }
}

TEST_CASE("a plane pushes no grain whose bounds lie in front of it") {
  CHECK_FALSE(Plane{{0, 1.0}, 0.1}.may_touch(of_ball));
  CHECK(Plane{{0, 1.0}, 0.11}.may_touch(of_ball));
  CHECK_FALSE(Plane{{1, -1.0}, 0.9}.may_touch(of_ball));
  CHECK(Plane{{1, -1.0}, 0.89}.may_touch(of_ball));
}

TEST_CASE("what a surface adds to the frequency squared of a node is its stiffness over the node's mass") {
  const Model model = ball_in_the_middle(ContactSurface::facets);
  std::vector<double> rate(static_cast<std::size_t>(model.nodes()), 0.0);
  add_surface_stiffness_rate(model, Plane{{0, 1.0}, 0.12}, of_ball, 0, rate);
  int touching = 0;
  for (std::size_t n = 0; n < rate.size(); ++n) {
    const bool behind = n < static_cast<std::size_t>(model.surface_node_count[0]) && model.position[4 * n] < 0.12;
    touching += behind ? 1 : 0;
    const double stiffness = model.penalty_stiffness[0] * model.local_stiffness(n) * model.reference_area[n];
    CHECK(within(rate[n], behind ? stiffness * model.inverse_mass[n] : 0.0, rounding));
  }
  CHECK(touching > 0);
}
