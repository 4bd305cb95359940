// The stable step of whole grains, by their largest frequency.

#include <catch2/catch.hpp>

#include <numeric>

#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/kernels/largest_frequency.hpp"
#include "solver/kernels/node_motion.hpp"
#include "tests/support/frequencies.hpp"
#include "tests/support/meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Model free_grain(const GrainMesh& mesh, ElementType element, double linear_viscosity) {
  Scenario scenario = holding_scenario(1);
  scenario.numerics.element = element;
  scenario.numerics.bulk_viscosity_linear = linear_viscosity;
  scenario.numerics.bulk_viscosity_quadratic = 0;
  return build_model(pack({mesh}, {1, 1, 1}), scenario, "test");
}

std::vector<double> no_contact(const Model& model) {
  return std::vector<double>(static_cast<std::size_t>(model.nodes()));
}

/// Largest kinetic energy in 4000 steps from small random velocities, over that at the start. It is infinite where the
/// motion ran away.
double growth(Model model, double step) {
  for (std::size_t i = 0; i < model.velocity.size(); ++i)
    model.velocity[i] = i % 4 == 3 ? 0.0 : 1e-3 * (static_cast<double>((7919 * i) % 101) - 50);
  const double start = kinetic_energy(model, 0, 0);
  double largest = 0;
  for (int i = 0; i < 4000; ++i) {
    advance(model, 0, {.step_mean = step, .step = step});
    if (!element_forces(model, 0, step).admissible) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, kinetic_energy(model, 0, 0));
    if (largest > 1e6 * start) return std::numeric_limits<double>::infinity();
  }
  return largest / start;
}

/// A ball with a node moved towards a neighbour until one of its tets is left with a hundredth of its volume.
GrainMesh ball_with_sliver() {
  GrainMesh mesh = ball_mesh(3, 0.1);
  const auto& tet = mesh.tet[mesh.tet.size() / 2];
  std::array<double, 3> middle{};
  for (int k = 1; k < 4; ++k)
    for (std::size_t a = 0; a < 3; ++a) middle[a] += mesh.node[static_cast<std::size_t>(tet[std::size_t(k)])][a] / 3;
  auto& x = mesh.node[static_cast<std::size_t>(tet[0])];
  for (std::size_t a = 0; a < 3; ++a) x[a] = middle[a] + 0.03 * (x[a] - middle[a]);
  return mesh;
}

} // namespace

// Lanczos' value lies below the eigenvalue by less than its residual, which is at most 2 % and is added.
TEST_CASE("the largest frequency of a grain is that of its assembled stiffness and mass, contact added") {
  for (const GrainMesh& mesh : {ball_mesh(3, 0.1), cube_mesh(3)}) {
    Model model = free_grain(mesh, ElementType::tet4, 0);
    const StableStep of_tets = stable_step(model, 0, {}, 0);
    std::vector<double> contact = no_contact(model);
    for (const double strength : {0.0, 1.0}) {
      // On surface nodes, as much as the worst tet has, and different from node to node.
      for (std::size_t n = 0; n < static_cast<std::size_t>(model.surface_node_count[0]); ++n)
        contact[n] = strength * (0.2 + 0.1 * static_cast<double>(n % 9)) * std::pow(2 / of_tets.step, 2);
      const Eigen::VectorXd all = squared_frequencies(model, contact);
      const double largest = all[all.size() - 1];
      const LargestFrequency found = largest_frequency(model, 0, contact, of_tets.step, 0);
      CAPTURE(strength, found.iterations, found.residual / largest);
      CHECK(found.squared > largest * (1 - 1e-5)); // of the differences that the reference comes from
      CHECK(found.squared < 1.03 * largest);
      CHECK(2 / std::sqrt(found.squared) > 1.1 * stable_step(model, 0, contact, 0).step);
    }
  }
}

TEST_CASE("sharing pressure does not raise the largest frequency") {
  for (const GrainMesh& mesh : {ball_mesh(3, 0.1), ball_with_sliver()}) {
    const Model plain = free_grain(mesh, ElementType::tet4, 0);
    for (const ElementType element : {ElementType::tet4_anp, ElementType::tet4_patch}) {
      const Eigen::VectorXd shared = squared_frequencies(free_grain(mesh, element, 0));
      CHECK(shared[shared.size() - 1] < largest_frequency(plain, 0, no_contact(plain), 1e-9, 0).squared);
    }
  }
}

TEST_CASE("a grain is stable just below the step of its largest frequency and not above, with bulk viscosity too") {
  for (const double viscosity : {0.0, 0.06, 0.3}) {
    Model model = free_grain(ball_mesh(3, 0.1), ElementType::tet4, viscosity);
    // Viscosity is taken at the tets' step and so a little too large: once more with what was found.
    double step = stable_step(model, 0, {}, 0).step;
    for (int i = 0; i < 3; ++i) step = 2 / std::sqrt(largest_frequency(model, 0, no_contact(model), step, 0).squared);
    CAPTURE(viscosity);
    CHECK(growth(model, 0.99 * step) < 3);
    CHECK(growth(model, 1.04 * step) > 1e6);
  }
}

TEST_CASE("single tets are stable at their own step for any share of viscous damping") {
  // The stiffest motion of a regular tet is a change of volume, which bulk viscosity damps by more than b1.
  GrainMesh mesh{{{0.05, 0.05, 0.05}, {0.05, -0.05, -0.05}, {-0.05, 0.05, -0.05}, {-0.05, -0.05, 0.05}},
                 {{0, 2, 1, 3}}};
  for (const double poissons_ratio : {0.0, 0.3, 0.45})
    for (const double viscosity : {0.0, 0.06, 0.3}) {
      Scenario scenario = holding_scenario(1);
      scenario.material.poissons_ratio = poissons_ratio;
      scenario.numerics.element = ElementType::tet4;
      scenario.numerics.bulk_viscosity_linear = viscosity;
      scenario.numerics.bulk_viscosity_quadratic = 0;
      Model model = build_model(pack({mesh}, {1, 1, 1}), scenario, "test");
      const double step = stable_step(model, 0, {}, 0).step;
      CAPTURE(poissons_ratio, viscosity);
      // Below the limit, at which it would be infinite, the velocity of a mode swings up to 1/sqrt(1 - 0.98^2) = 5
      // times as far.
      CHECK(growth(model, 0.98 * step) < 26);
      CHECK(growth(model, 1.02 * step) > 1e6);
    }
}

TEST_CASE("frequencies of a grain grow by no more than those of the tet that grows most") {
  // Pressed flat by a third in small moves, with the estimates of a run between: the sliver, which sets the step of
  // single tets, strains like the rest, but others come to set that of the whole.
  Model model = free_grain(ball_with_sliver(), ElementType::tet4, 0.06);
  StableStep of_tets = stable_step(model, 0, {}, 0);
  const double first = largest_frequency(model, 0, no_contact(model), of_tets.step, 0).squared;
  double grown = 1;
  for (int move = 0; move < 20; ++move) {
    for (std::size_t n = 0; n < model.position.size(); n += 4) {
      model.position[n + 2] *= 0.98;
      model.position[n] *= 1 + 0.3 * model.position[n]; // the one side more than the other
    }
    of_tets = stable_step(model, 0, {}, 0);
    grown *= of_tets.growth;
    const double now = largest_frequency(model, 0, no_contact(model), of_tets.step, 0).squared;
    CAPTURE(move, now / first, grown);
    CHECK(now < 1.02 * first * grown); // 2 %: what either value may be above the eigenvalue
  }
  CHECK(grown > 1.5);
}

TEST_CASE("a sliver does not shorten the step of a grain as it does by itself") {
  Model model = free_grain(ball_with_sliver(), ElementType::tet4, 0.06);
  const double of_tets = stable_step(model, 0, {}, 0).step;
  const double whole = 2 / std::sqrt(largest_frequency(model, 0, no_contact(model), of_tets, 0).squared);
  CAPTURE(of_tets, whole);
  CHECK(whole > 2 * of_tets);
  CHECK(growth(model, 0.98 * whole) < 3);
}
