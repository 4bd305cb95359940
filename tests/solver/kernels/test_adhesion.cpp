// The studies fig04 and fig05 in small: hemispheres on coarse meshes against theory and converged finite elements.

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "pack-gen/hemispheres.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/hertz_column.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double sphere = 0.1; // R, mm

struct Pair {
  Scenario scenario;
  MeshedPacking packing;
};

/// A pair with elements of `size` (mm) to be pressed by `approach` and pulled apart by `opening` (mm).
Pair hemispheres(double size, double contact_radius, double approach, double opening, double speed) {
  const Hemispheres meshes = mesh_hemispheres({.radius = sphere,
                                               .size = 0.015,
                                               .contact_size = size,
                                               .contact_radius = contact_radius,
                                               .bulk_size = 2 * size,
                                               .gap = 1e-6});
  Pair pair;
  pair.packing.box_lengths = meshes.packing.box;
  pair.packing.node = meshes.mesh.node;
  pair.packing.tet = meshes.mesh.tet;
  pair.packing.grain_node_offset = meshes.mesh.grain_node_offset;
  pair.packing.grain_tet_offset = meshes.mesh.grain_tet_offset;
  pair.scenario = holding_scenario(1);
  Stage press = pair.scenario.stages[0], pull;
  press.type = GripMotion{2, 1e-6, true, -(approach + 1e-6), {}, speed, 0.5};
  pull = press;
  pull.name = "pull";
  std::get<GripMotion>(pull.type).displacement = opening;
  pair.scenario.stages = {press, pull};
  pair.scenario.numerics.mass_scaling_step = 4e-7 * size;
  pair.scenario.numerics.mass_scaling_lighten = true;
  return pair;
}

/// Force (N) of the grips, both sides' mean: inertia cancels.
double grip_force(const HistoryRow& row) {
  return 0.5 * (row.wall_stress[4] + row.wall_stress[5]) * row.box_lengths[0] * row.box_lengths[1];
}

} // namespace

TEST_CASE("elastic hemispheres load as Hertz and pull off as Johnson, Kendall and Roberts") {
  constexpr double energy = 0.1, reduced = 5000 / (2 * 0.91), mean_radius = 0.5 * sphere;
  const double pull_off = 1.5 * M_PI * energy * mean_radius;
  const double pull_off_radius = std::cbrt(9 * M_PI * energy * mean_radius * mean_radius / (8 * reduced));
  const double approach = std::pow(1.25 * pull_off_radius, 2) / mean_radius;
  // Down to where the branch of the theory ends, before the hemispheres fly apart.
  const double end = 0.75 * std::cbrt(M_PI * M_PI * energy * energy * mean_radius / (reduced * reduced));
  Pair pair = hemispheres(pull_off_radius / 5, 1.4 * pull_off_radius, approach, approach + end, 600);
  const double strength = std::cbrt(M_PI * energy * std::pow(4 * reduced / 3, 2) / mean_radius); // lambda = 2
  pair.scenario.bond = BondParameters{strength, strength, energy, SofteningLaw::exponential, false, true};
  ThreadTeam team(1);
  Simulation simulation(build_model(pair.packing, pair.scenario, "test"), pair.scenario, team);
  const Record record = run_stages(simulation, pair.scenario);
  const double hertz =
      4.0 / 3 * reduced * std::sqrt(mean_radius) * std::pow(approach, 1.5) * finite_sphere_factor(approach / sphere);
  // Plain tets are too stiff, by about the element size over the contact radius: 10 % with six elements in it.
  CHECK(grip_force(record.last[0]) / hertz == Approx(1.08).margin(0.06));
  // Pull-off does not depend on the stiffness: boundary elements with these bonds give 1.005 of JKR.
  CHECK(record.largest_tension / pull_off == Approx(1.005).margin(0.05));
  CHECK(record.worst_residual < 0.02);
}

TEST_CASE(
    "elasto-plastic hemispheres load as converged finite elements do, with averaged pressure within half the error") {
  double error[2] = {};
  for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp}) {
    Pair pair = hemispheres(0.0028, 0.022, 0.004, 1e-4, 600);
    pair.scenario.material.hardening = {HardeningLaw::power, 25, 125, 0.3, {}, {}};
    pair.scenario.numerics.element = element;
    pair.scenario.stages.pop_back();
    ThreadTeam team(1);
    Simulation simulation(build_model(pair.packing, pair.scenario, "test"), pair.scenario, team);
    const Record record = run_stages(simulation, pair.scenario);
    // F/(E R^2) = 2.7810e-3 at h/R = 0.04 (studies/fig05/finite-elements.csv); plain tets are too stiff by some 8 %
    // here.
    error[element == ElementType::tet4 ? 0 : 1] = grip_force(record.last[0]) / (2.7810e-3 * 5000 * sphere * sphere) - 1;
    CHECK(record.worst_residual < 0.01);
  }
  CAPTURE(error[0], error[1]);
  CHECK(error[0] == Approx(0.07).margin(0.06));
  CHECK(std::abs(error[1]) < 0.6 * error[0]);
}
