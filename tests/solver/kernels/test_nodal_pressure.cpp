// Pressures averaged around nodes or over patches have no weak modes: spectrum and free vibration of one elastic grain,
// against Lamb's sphere.

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "solver/run/simulation.hpp"
#include "tests/support/free_sphere.hpp"
#include "tests/support/frequencies.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"
#include "tests/support/volume_state.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Scenario vibrating_scenario(ElementType element) {
  Scenario scenario = holding_scenario(1);
  scenario.numerics.element = element;
  scenario.numerics.bulk_viscosity_linear = 0;
  scenario.numerics.bulk_viscosity_quadratic = 0;
  return scenario;
}

} // namespace

TEST_CASE(
    "eigenfrequencies of the free sphere: breathing obeys its own equation, torsion does not know Poisson's ratio") {
  for (const double nu : {0.0, 0.25, 0.3, 0.45}) {
    const double eta = sphere_eigenvalue(SphereMode::spheroidal, 0, nu);
    const double xi = eta * std::sqrt((1 - 2 * nu) / (2 - 2 * nu));
    CHECK(within(std::tan(xi) / xi, 4 / (4 - eta * eta), 1e-9));
    CHECK(within(sphere_eigenvalue(SphereMode::torsional, 2, nu), 2.50113, 1e-5));
  }
  // Poisson's solid: 0.8160 pi and 0.840 pi (Love, A Treatise on the Mathematical Theory of Elasticity).
  CHECK(within(sphere_eigenvalue(SphereMode::spheroidal, 0, 0.25) / std::sqrt(3.0), 0.8160 * M_PI, 1e-4));
  CHECK(within(sphere_eigenvalue(SphereMode::spheroidal, 2, 0.25), 0.840 * M_PI, 1e-3));
}

// The lowest elastic modes of a sphere of nu = 0.3 are the five torsional ones with l = 2 (2.5011 c_s/R) and the five
// ellipsoidal ones (2.6462 c_s/R). A weak mode would stand among or below them.
TEST_CASE("shared pressures have six rigid modes and no weak one: the next are those of the elastic sphere") {
  const ElementType element = GENERATE(ElementType::tet4_anp, ElementType::tet4_patch);
  CAPTURE(element_name(element));
  const double radius = 0.1;
  const GrainMesh mesh = ball_mesh(6, radius);
  const auto frequencies = [&mesh](ElementType type) {
    return squared_frequencies(build_model(pack({mesh}, {1, 1, 1}), vibrating_scenario(type), "test"));
  };
  const Eigen::VectorXd averaged = frequencies(element), plain = frequencies(ElementType::tet4);
  const double torsional = sphere_frequency(SphereMode::torsional, 2, radius, 5000, 0.3, 1.55e-9),
               ellipsoidal = sphere_frequency(SphereMode::spheroidal, 2, radius, 5000, 0.3, 1.55e-9);
  for (int i = 0; i < 6; ++i) CHECK(std::abs(averaged[i]) < 1e-4 * torsional * torsional);
  std::string lowest;
  for (int i = 6; i < 20; ++i) lowest += fmt::format(" {:.6f}", std::sqrt(averaged[i]) / torsional);
  CAPTURE(lowest);
  // Lumped masses lower frequencies and a coarse mesh raises them: within a tenth, all ten.
  for (int i = 6; i < 16; ++i) {
    CHECK(std::sqrt(averaged[i]) > 0.9 * torsional);
    CHECK(std::sqrt(averaged[i]) < 1.1 * ellipsoidal);
  }
  CHECK(std::sqrt(averaged[16]) > 1.1 * ellipsoidal);
  // Never stiffer than plain tets, mode by mode (Cauchy's inequality and the minimum-maximum principle), nor much
  // softer.
  double ratio = 1;
  for (Eigen::Index i = 6; i < averaged.size(); ++i) {
    CHECK(averaged[i] <= plain[i] * (1 + 1e-6));
    ratio = std::min(ratio, std::sqrt(averaged[i] / plain[i]));
  }
  CAPTURE(ratio);
  CHECK(ratio > 0.5);
}

TEST_CASE(
    "a freely vibrating grain with shared pressures keeps its energy, and its pressure does not begin to oscillate") {
  const ElementType element = GENERATE(ElementType::tet4_anp, ElementType::tet4_patch);
  CAPTURE(element_name(element));
  const Scenario scenario = vibrating_scenario(element);
  GrainMesh mesh = ball_mesh(5, 0.1);
  rotate(mesh, {0.6, 0, 0.8}, 0.7);
  move(mesh, {0.5, 0.5, 0.5});
  ThreadTeam team(1);
  Simulation simulation(build_model(pack({mesh}, {1, 1, 1}), scenario, "test"), scenario, team);
  Model& model = simulation.model_to_disturb();
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n)
    for (std::size_t a = 0; a < 3; ++a)
      model.velocity[4 * n + a] = (a == 2 ? -4e4 : 2e4) * (model.position[4 * n + a] - 0.5); // 4 m/s at the poles
  const auto neighbours = tet_neighbours(model);
  constexpr int steps = 20000, windows = 5;
  double energy = 0, worst = 0, first = 0, last = 0, previous = 0, begun = 0, ended = 0;
  int upward = 0;
  VolumeState sum;
  for (int step = 0; step < steps; ++step) {
    simulation.evaluate_forces();
    if (step % 20 == 0) {
      const HistoryRow row = simulation.observe();
      if (step == 0) energy = row.kinetic_energy + row.elastic_energy;
      worst = std::max(worst, std::abs(row.kinetic_energy + row.elastic_energy - energy));
      const VolumeState now = volume_state(model, neighbours);
      sum.averaged_square += now.averaged_square, sum.tet_square += now.tet_square;
    }
    if ((step + 1) % (steps / windows) == 0) {
      last = std::sqrt(sum.tet_square / sum.averaged_square);
      if (first == 0) first = last;
      sum = {};
    }
    // Times at which the rate of flattening passes zero upwards: whole periods between them.
    double rate = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n)
      rate += model.velocity[4 * n + 2] * (model.position[4 * n + 2] - 0.5) / model.inverse_mass[n];
    const double time = simulation.state().time - 0.5 * simulation.state().last_step;
    if (step > 0 && previous < 0 && rate >= 0) {
      if (upward == 0) begun = time;
      ended = time;
      ++upward;
    }
    previous = rate;
    simulation.advance();
  }
  CAPTURE(worst / energy, first, last, upward);
  CHECK(worst < 0.01 * energy);
  CHECK(first > 0.01); // the measure sees the mesh: it is not zero
  CHECK(last < 1.5 * first);
  REQUIRE(upward > 10);
  const double frequency = (upward - 1) / (ended - begun);
  const double reference = sphere_frequency(SphereMode::spheroidal, 2, 0.1, 5000, 0.3, 1.55e-9) / (2 * M_PI);
  CAPTURE(frequency, reference);
  CHECK(within(frequency, reference, 0.05));
}
