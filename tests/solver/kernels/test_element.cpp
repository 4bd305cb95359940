// The element pass on whole grains.

#include <map>

#include <catch2/catch.hpp>

#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/physics/tet4_patch.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Model single_grain(const GrainMesh& mesh, HardeningLaw law = HardeningLaw::elastic,
                   ElementType element = ElementType::tet4) {
  Scenario scenario = holding_scenario(1, law);
  scenario.numerics.element = element;
  scenario.numerics.bulk_viscosity_linear = 0;
  scenario.numerics.bulk_viscosity_quadratic = 0;
  return build_model(pack({mesh}, {1, 1, 1}), scenario, "test");
}

std::array<double, 3> total_force(const Model& model) {
  std::array<double, 3> sum{};
  for (std::size_t n = 0; n < model.force.size() / 4; ++n)
    for (std::size_t a = 0; a < 3; ++a) sum[a] += model.force[4 * n + a];
  return sum;
}

} // namespace

TEST_CASE("patch test: a linear displacement field gives one stress everywhere and no force inside") {
  GrainMesh mesh = cube_mesh(4);
  // Interior nodes displaced at random so that the patch is irregular.
  unsigned seed = 7;
  for (auto& x : mesh.node) {
    const bool inside = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}) < 0.99;
    for (double& c : x) {
      seed = seed * 1664525U + 1013904223U;
      if (inside) c += 0.12 * (static_cast<double>(seed) / 4294967296.0 - 0.5);
    }
  }
  const auto law = GENERATE(HardeningLaw::elastic, HardeningLaw::power);
  const auto element = GENERATE(ElementType::tet4, ElementType::tet4_anp);
  CAPTURE(element_name(element));
  Model model = single_grain(mesh, law, element);
  const double gradient[3][3] = {{0.004, 0.001, -0.002}, {0.003, -0.005, 0.001}, {0.002, 0.0, 0.006}};
  const double step = 1e-9;
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n) {
      // the same velocity field for everybody: v = G x / dt at the start of the step
      double v[3] = {};
      for (int i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) v[i] += gradient[i][j] * model.position[4 * n + j] / step;
      for (std::size_t i = 0; i < 3; ++i) model.velocity[4 * n + i] = v[i], model.position[4 * n + i] += step * v[i];
    }
    REQUIRE(element_forces(model, 0, step).admissible);
  }
  const TetFields fields = tet_fields(model, 0);
  if (law == HardeningLaw::power) REQUIRE(fields.plastic_strain[0] > 1e-4F); // the case really yields
  for (std::size_t t = 0; t < fields.von_mises.size(); ++t) {
    REQUIRE(within(static_cast<double>(fields.von_mises[t]), static_cast<double>(fields.von_mises[0]), 1e-6));
    REQUIRE(within(static_cast<double>(fields.pressure[t]), static_cast<double>(fields.pressure[0]), 1e-5));
  }
  const double scale = static_cast<double>(fields.von_mises[0]) * 0.25; // stress times facet area
  double largest = 0;
  for (std::int32_t n = model.surface_node_count[0]; n < model.nodes(); ++n)
    for (std::size_t a = 0; a < 3; ++a)
      largest = std::max(largest, std::abs(model.force[4 * static_cast<std::size_t>(n) + a]));
  CHECK(largest < accumulated_rounding * scale);
}

TEST_CASE("internal forces of a grain add up to zero") {
  Model model =
      single_grain(ball_mesh(6, 0.1), HardeningLaw::power, GENERATE(ElementType::tet4, ElementType::tet4_anp));
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n) {
    const double* x = &model.position[4 * n];
    const double v[3] = {1e4 * x[1] * x[1], -3e3 * x[0], 2e3 * x[2]};
    for (std::size_t a = 0; a < 3; ++a) model.velocity[4 * n + a] = v[a];
  }
  for (std::size_t i = 0; i < model.position.size(); ++i) model.position[i] += 1e-6 * model.velocity[i];
  REQUIRE(element_forces(model, 0, 1e-6).admissible);
  double magnitude = 0;
  for (const double f : model.force) magnitude += std::abs(f);
  REQUIRE(magnitude > 1e-3);
  for (const double component : total_force(model)) CHECK(std::abs(component) < rounding * magnitude);
}

TEST_CASE("a full turn of a stressed grain in steps leaves its stress unchanged") {
  Model model =
      single_grain(ball_mesh(4, 0.1), HardeningLaw::elastic, GENERATE(ElementType::tet4, ElementType::tet4_anp));
  const double step = 1e-9;
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n) {
    double* x = &model.position[4 * n];
    double* v = &model.velocity[4 * n];
    v[0] = 1e-3 * x[0] / step, v[1] = -2e-3 * x[1] / step, v[2] = 1e-3 * x[0] / step;
    for (std::size_t a = 0; a < 3; ++a) x[a] += step * v[a];
  }
  REQUIRE(element_forces(model, 0, step).admissible);
  const LazyArray<double> positions = model.position;
  const TetFields before = tet_fields(model, 0);
  const double energy = elastic_energy(model, 0);
  REQUIRE(energy > 0);

  const int steps = 200;
  for (int i = 1; i <= steps; ++i) {
    const double angle = 2 * M_PI * i / steps;
    const double axis[3] = {2.0 / 7, 3.0 / 7, 6.0 / 7};
    for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n) {
      const double* x0 = &positions[4 * n];
      const double d = axis[0] * x0[0] + axis[1] * x0[1] + axis[2] * x0[2];
      const double k[3] = {axis[1] * x0[2] - axis[2] * x0[1], axis[2] * x0[0] - axis[0] * x0[2],
                           axis[0] * x0[1] - axis[1] * x0[0]};
      for (std::size_t a = 0; a < 3; ++a) {
        const double x = std::cos(angle) * x0[a] + std::sin(angle) * k[a] + (1 - std::cos(angle)) * d * axis[a];
        model.velocity[4 * n + a] = (x - model.position[4 * n + a]) / step;
        model.position[4 * n + a] = x;
      }
    }
    REQUIRE(element_forces(model, 0, step).admissible);
  }
  CHECK(within(elastic_energy(model, 0), energy, 1e-10));
  const TetFields after = tet_fields(model, 0);
  for (std::size_t t = 0; t < after.von_mises.size(); ++t)
    CHECK(std::abs(after.von_mises[t] - before.von_mises[t]) < 1e-5F * 20);
}

TEST_CASE("a freely spinning grain keeps its energy and angular momentum over many turns") {
  // Surface speed 100 m/s: centrifugal stresses (15 MPa) stretch the grain a little, and it vibrates.
  Scenario scenario = holding_scenario(20 * 2 * M_PI / 1e6);
  scenario.grain_angular_velocity = {{6e5, 0.0, 8e5}};
  scenario.numerics.element = GENERATE(ElementType::tet4, ElementType::tet4_anp);
  scenario.numerics.bulk_viscosity_linear = 0;
  scenario.numerics.bulk_viscosity_quadratic = 0;
  ThreadTeam team(1);
  GrainMesh mesh = ball_mesh(4, 0.1);
  Simulation simulation(build_model(pack({mesh}, {1, 1, 1}), scenario, "test"), scenario, team);
  const auto momentum = [&] {
    std::array<double, 3> l{};
    const Model& m = simulation.model();
    for (std::size_t n = 0; n < static_cast<std::size_t>(m.nodes()); ++n) {
      const double *x = &m.position[4 * n], *v = &m.velocity[4 * n];
      const double mass = 1 / m.inverse_mass[n];
      l[0] += mass * (x[1] * v[2] - x[2] * v[1]);
      l[1] += mass * (x[2] * v[0] - x[0] * v[2]);
      l[2] += mass * (x[0] * v[1] - x[1] * v[0]);
    }
    return l;
  };
  const auto start = momentum();
  const double initial = simulation.energies().initial;
  double worst = 0;
  while (!simulation.stage_complete()) {
    simulation.evaluate_forces();
    if (simulation.state().step % 500 == 0) worst = std::max(worst, std::abs(simulation.observe().energy_residual));
    simulation.advance();
  }
  simulation.evaluate_forces();
  REQUIRE(simulation.state().step > 5000);
  worst = std::max(worst, std::abs(simulation.observe().energy_residual));
  CHECK(worst < 2e-3 * initial);
  const auto end = momentum();
  for (std::size_t a = 0; a < 3; ++a)
    CHECK(std::abs(end[a] - start[a]) < 1e-9 * (std::abs(start[0]) + std::abs(start[2])));
}

TEST_CASE("the pressure of nodes or of patches is the gradient of its energy, with a share of the tets' own too") {
  const auto [element, own] =
      GENERATE(std::pair(ElementType::tet4_anp, 0.0), std::pair(ElementType::tet4_anp, 0.3),
               std::pair(ElementType::tet4_patch, 0.0), std::pair(ElementType::tet4_patch, 0.03));
  CAPTURE(element_name(element), own);
  // Without a deviator (a grain that has not moved yet) forces come from the pressure alone: compare with differences
  // of the energy over small moves of single coordinates.
  GrainMesh mesh = ball_mesh(3, 1.0);
  for (auto& x : mesh.node) x[0] *= 1 + 0.02 * x[1], x[2] *= 1 - 0.03 * x[0];
  Model model = single_grain(mesh, HardeningLaw::elastic, element);
  model.own_pressure = own;
  // Away from the reference state: volumes change by some per cent, differently everywhere.
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n) {
    double* x = &model.position[4 * n];
    x[0] += 0.03 * x[1] * x[1], x[1] -= 0.02 * x[0] * x[2], x[2] += 0.02 * x[2] * x[0];
  }
  REQUIRE(element_forces(model, 0, 1e-9).admissible); // velocities are zero: the deviator stays zero
  const LazyArray<double> force = model.force;
  double largest = 0;
  for (const double f : force) largest = std::max(largest, std::abs(f));
  constexpr double move = 1e-5; // of a radius: truncation 1e-10, rounding of the energy 1e-11
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); n += 5)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& x = model.position[4 * n + axis];
      const double at = x;
      x = at + move;
      const double above = elastic_energy(model, 0);
      x = at - move;
      const double below = elastic_energy(model, 0);
      x = at;
      REQUIRE(std::abs(-(above - below) / (2 * move) - force[4 * n + axis]) < 1e-6 * largest);
    }
}

TEST_CASE("pressures of nodes and of patches do not lock in isochoric flow, and plain tets do") {
  // The nodes of a cube follow a smooth field without change of volume. Between the nodes plain tets cannot follow it
  // without changing theirs: their volumetric energy is spurious, that of shared pressures is smaller by far.
  std::map<ElementType, double> volumetric;
  for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp, ElementType::tet4_patch}) {
    Model model = single_grain(cube_mesh(6), HardeningLaw::elastic, element);
    for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n) {
      double* x = &model.position[4 * n];
      // u = curl(0, 0, psi), psi = c cos(pi x/2) cos(pi y/2): divergence-free; the cube is [-1, 1]^3.
      const double c = 0.01, sx = std::sin(M_PI_2 * x[0]), cx = std::cos(M_PI_2 * x[0]), sy = std::sin(M_PI_2 * x[1]),
                   cy = std::cos(M_PI_2 * x[1]);
      x[0] += -c * M_PI_2 * cx * sy, x[1] += c * M_PI_2 * sx * cy;
    }
    REQUIRE(element_forces(model, 0, 1e-9).admissible);
    volumetric[element] = elastic_energy(model, 0);
  }
  CAPTURE(volumetric[ElementType::tet4], volumetric[ElementType::tet4_anp], volumetric[ElementType::tet4_patch]);
  CHECK(volumetric[ElementType::tet4_anp] < 0.1 * volumetric[ElementType::tet4]);
  // Of this mesh eight tets are more constraints than the nodes, which have six each.
  CHECK(volumetric[ElementType::tet4_patch] < 0.2 * volumetric[ElementType::tet4]);
}

TEST_CASE("patches are eight adjacent tets, and the last patch of a grain holds the remaining ones") {
  const GrainMesh mesh = ball_mesh(5, 1.0);
  const Model model = single_grain(mesh, HardeningLaw::elastic, ElementType::tet4_patch);
  const auto tets = static_cast<std::size_t>(model.tets());
  REQUIRE(model.inverse_patch_volume.size() == (tets + patch_tets - 1) / patch_tets);
  double total = 0;
  for (const double inverse : model.inverse_patch_volume) total += 1 / inverse;
  CHECK(total == Approx(model.reference_volume[0]).epsilon(1e-12));
  // The centres of a patch spread about theirs no further than eight tets that fill a cube of their volume do, with
  // some allowance for shape: a root mean square of half its edge for points spread evenly.
  double worst = 0;
  for (std::size_t patch = 0; patch < model.inverse_patch_volume.size(); ++patch) {
    std::vector<std::array<double, 3>> centres;
    std::array<double, 3> middle{};
    for (std::size_t t = patch_tets * patch; t < std::min<std::size_t>(patch_tets * (patch + 1), tets); ++t) {
      std::array<double, 3> centre{};
      for (const std::int32_t node : mesh.tet[static_cast<std::size_t>(model.file_tet[t])])
        for (std::size_t a = 0; a < 3; ++a) centre[a] += mesh.node[static_cast<std::size_t>(node)][a] / 4;
      centres.push_back(centre);
    }
    for (const auto& centre : centres)
      for (std::size_t a = 0; a < 3; ++a) middle[a] += centre[a] / static_cast<double>(centres.size());
    double square = 0;
    for (const auto& centre : centres)
      for (std::size_t a = 0; a < 3; ++a)
        square += (centre[a] - middle[a]) * (centre[a] - middle[a]) / static_cast<double>(centres.size());
    worst = std::max(worst, std::sqrt(square) * std::cbrt(model.inverse_patch_volume[patch]));
  }
  CHECK(worst < 1.0);
}

TEST_CASE("the step estimate bounds the eigenfrequency of a single tet and is not far from it") {
  // A unit right tet: run one element at 0.98 and 1.6 of the estimate; the first stays bounded, the second blows up.
  GrainMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  for (const double factor : {0.98, 1.6}) {
    Scenario scenario = holding_scenario(1);
    scenario.numerics.bulk_viscosity_linear = 0;
    scenario.numerics.bulk_viscosity_quadratic = 0;
    Model model = build_model(pack({mesh}, {1, 1, 1}), scenario, "test");
    const double step = factor * stable_step(model, 0, {}, 0).step;
    for (std::size_t i = 0; i < 16; ++i) model.velocity[i] = i % 4 == 3 ? 0.0 : 1e-3 * static_cast<double>((7 * i) % 5);
    const double start = kinetic_energy(model, 0, 0);
    double largest = 0;
    bool admissible = true;
    for (int i = 0; i < 2000 && admissible; ++i) {
      advance(model, 0, {.step_mean = step, .step = step});
      admissible = element_forces(model, 0, step).admissible;
      largest = std::max(largest, kinetic_energy(model, 0, 0));
      if (largest > 1e6 * start) break;
    }
    CAPTURE(factor);
    if (factor < 1) {
      CHECK(admissible);
      CHECK(largest < 1.5 * start);
    } else {
      CHECK(largest > 100 * start);
    }
  }
}

TEST_CASE("an inverted tet is found and named") {
  Model model = single_grain(cube_mesh(2));
  model.position[4 * 3] += 50; // one node far away turns neighbours inside out
  CHECK_FALSE(element_forces(model, 0, 1e-9).admissible);
  CHECK(find_bad_tet(model, 0).file_tet >= 0);
}
