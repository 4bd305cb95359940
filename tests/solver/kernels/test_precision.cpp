// Mixed precision: strains and stresses of tets in floats.

#include <random>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/physics/plasticity.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// A few roundings of floats, each up to 6e-8 of the number.
constexpr double few_single_roundings = 1e-6;

Scenario compaction(Precision precision, ElementType element) {
  Scenario scenario = compaction_scenario(0.75, 20000);
  scenario.numerics.precision = precision;
  scenario.numerics.element = element;
  scenario.numerics.own_pressure = usual_own_pressure(element);
  return scenario;
}

HistoryRow compacted(Precision precision, ElementType element) {
  const Scenario scenario = compaction(precision, element);
  ThreadTeam team(1);
  Simulation simulation(build_model(eight_grains(4), scenario, "test"), scenario, team);
  while (true) {
    simulation.evaluate_forces();
    if (simulation.stage_complete()) return simulation.observe();
    simulation.advance();
  }
}

} // namespace

TEST_CASE("every lane of a pack of floats gives the scalar answer within a few roundings") {
  using S = Pack<native_lanes_of<float>, float>;
  const PowerLaw law{25, 125, 0.3};
  const ElasticModuli moduli = elastic_moduli(5000, 0.3);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int repeat = 0; repeat < 300; ++repeat) {
    const double size = std::pow(10, -5 + 2 * (uniform(random) + 1));
    // Doubles that are floats, so that both sides begin at the same numbers.
    const auto number = [&](double scale) { return static_cast<double>(static_cast<float>(uniform(random) * scale)); };
    Deviator<S> s{S(0.0), S(0.0), S(0.0), S(0.0), S(0.0)};
    HardeningState<S> hardening{S(0.0), S(0.0)};
    Increment<S> increment{};
    for (int lane = 0; lane < S::lanes; ++lane) {
      for (S* stress : {&s.xx, &s.yy, &s.xy, &s.yz, &s.zx}) stress->v[lane] = static_cast<float>(number(15));
      for (S* strain : {&increment.strain.xx, &increment.strain.yy, &increment.strain.zz, &increment.strain.xy,
                        &increment.strain.yz, &increment.strain.zx, &increment.rotation.x, &increment.rotation.y,
                        &increment.rotation.z})
        strain->v[lane] = static_cast<float>(number(size));
      const double strain = lane % 2 == 0 ? 0.0 : std::abs(number(0.1));
      hardening.plastic_strain.v[lane] = static_cast<float>(strain);
      hardening.flow_stress.v[lane] = static_cast<float>(25 + 125 * std::pow(strain, 0.3));
    }
    const auto pack = update_deviator(law, moduli, s, hardening, increment);
    for (int lane = 0; lane < S::lanes; ++lane) {
      const auto of = [lane](const S& numbers) { return static_cast<double>(numbers[lane]); };
      const auto scalar = update_deviator(
          law, moduli, Deviator<double>{of(s.xx), of(s.yy), of(s.xy), of(s.yz), of(s.zx)},
          HardeningState<double>{of(hardening.flow_stress), of(hardening.plastic_strain)},
          Increment<double>{{of(increment.strain.xx), of(increment.strain.yy), of(increment.strain.zz),
                             of(increment.strain.xy), of(increment.strain.yz), of(increment.strain.zx)},
                            {of(increment.rotation.x), of(increment.rotation.y), of(increment.rotation.z)}});
      // The trial stress is the largest number of all: its rounding is that of what comes of it.
      const double scale = 25 + 6 * moduli.shear * size;
      CHECK(std::abs(of(pack.deviator.xx) - scalar.deviator.xx) < few_single_roundings * scale);
      CHECK(std::abs(of(pack.deviator.zx) - scalar.deviator.zx) < few_single_roundings * scale);
      CHECK(std::abs(of(pack.hardening.flow_stress) - scalar.hardening.flow_stress) < 2 * few_single_roundings * scale);
      CHECK(std::abs(of(pack.hardening.plastic_strain) - scalar.hardening.plastic_strain) <
            few_single_roundings * (scale / (3 * moduli.shear) + 0.1));
    }
  }
}

TEST_CASE("a strain too small for a float does not keep a point elastic for ever") {
  // Plastic strain is below 1e-38 until the stress has risen by 2e-4 of k where m = 0.1, by 0.013 k where m = 0.05, and
  // grows as its tenth or twentieth power; steps of both take part in it, larger and smaller than that.
  using S = Pack<native_lanes_of<float>, float>;
  const double three_shear = 3 * 1923.0;
  for (const double exponent : {0.05, 0.1, 0.3})
    for (const double excess : {1e-3, 2e-2}) {
      const PowerLaw law{25, 125, exponent};
      HardeningState<S> point{S(25.0), S(0.0)};
      HardeningState<double> exact{25, 0};
      for (int step = 0; step * excess < 120; ++step) {
        point = law.end_of_increment(point.flow_stress + S(excess), point, three_shear);
        exact = law.end_of_increment(exact.flow_stress + excess, exact, three_shear);
      }
      CAPTURE(exponent, excess, exact.plastic_strain, exact.flow_stress, point.plastic_strain[0], point.flow_stress[0]);
      REQUIRE(exact.plastic_strain > 1e-3);
      // Roundings of 120,000 increments, a 3e-8th of the stress each, where they all add up.
      CHECK(within(point.plastic_strain[0], exact.plastic_strain, 1e-2));
      CHECK(within(point.flow_stress[0], exact.flow_stress, 1e-3));
      // The double itself against the curve.
      CHECK(within(exact.flow_stress, 25 + 125 * std::pow(exact.plastic_strain, exponent), 1e-6));
    }
}

TEST_CASE("the energy of a small change of volume is resolved") {
  // K (J ln J - J + 1) = K x^2/2 (1 - x/3 + x^2/6 - …) with x = J - 1, to fifth order below 1e-15 of it.
  const ElasticModuli moduli{1, 1};
  using S = Pack<native_lanes_of<float>, float>;
  for (const double x : {-0.09, -1e-3, -1e-6, 1e-5, 1e-2, 0.09}) {
    double series = 0;
    for (int n = 30; n >= 2; --n) series += (n % 2 == 0 ? 1 : -1) * std::pow(x, n) / (n * (n - 1.0));
    CHECK(within(volumetric_energy(moduli, 1 + x), series, 4e-16 / std::abs(x) + 1e-14));
    const double ratio = static_cast<double>(static_cast<float>(1 + x)), y = ratio - 1;
    series = 0;
    for (int n = 30; n >= 2; --n) series += (n % 2 == 0 ? 1 : -1) * std::pow(y, n) / (n * (n - 1.0));
    if (y != 0) CHECK(within(volumetric_energy(moduli, S(ratio))[0], series, few_single_roundings));
  }
}

// Stresses are sums of some thousand increments, each rounded to 6e-8 of the stress: 1e-5 if they all added up, less by
// chance. Contacts that open or close a step earlier or later scatter by more.
TEST_CASE("a compaction in mixed precision is that in doubles") {
  for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp, ElementType::tet4_patch}) {
    const HistoryRow full = compacted(Precision::full, element), mixed = compacted(Precision::mixed, element);
    CAPTURE(element_name(element), full.mean_stress, mixed.mean_stress);
    REQUIRE(full.mean_stress > 10);
    CHECK(mixed.mean_stress != full.mean_stress); // it is another computation
    CHECK(within(mixed.mean_stress, full.mean_stress, 1e-4));
    CHECK(within(mixed.plastic_dissipation, full.plastic_dissipation, 1e-4));
    CHECK(within(mixed.elastic_energy, full.elastic_energy, 1e-4));
    CHECK(std::abs(mixed.energy_residual - full.energy_residual) < 1e-4 * full.external_work);
  }
}

TEST_CASE("elements that floats do not resolve in their grain are refused in mixed precision") {
  // A tetrahedron of 1.1e-4 mm in a grain of 0.2 mm.
  GrainMesh mesh = ball_mesh(1, 0.1);
  const auto first = static_cast<std::int32_t>(mesh.node.size());
  constexpr double edge = 1.1e-4;
  for (const std::array<double, 3> x :
       {std::array{0.0, 0.0, 0.0}, {edge, 0.0, 0.0}, {0.0, edge, 0.0}, {0.0, 0.0, edge}})
    mesh.node.push_back(x);
  mesh.tet.push_back({first, first + 1, first + 2, first + 3});
  move(mesh, {0.5, 0.5, 0.5});
  Scenario scenario = holding_scenario(1);
  const MeshedPacking packing = pack({mesh}, {1, 1, 1});
  CHECK_NOTHROW(build_model(packing, scenario, "test"));
  scenario.numerics.precision = Precision::mixed;
  CHECK_THROWS_WITH(build_model(packing, scenario, "test"), Catch::Contains("lies in a grain of"));
}

TEST_CASE("elements whose powers are no floats are refused in mixed precision") {
  for (const double factor : {1e-5, 1e7}) {
    GrainMesh mesh = ball_mesh(3, 0.1);
    scale(mesh, factor);
    Scenario scenario = holding_scenario(1);
    const MeshedPacking packing = pack({mesh}, {1, 1, 1});
    CHECK_NOTHROW(build_model(packing, scenario, "test"));
    scenario.numerics.precision = Precision::mixed;
    CHECK_THROWS_WITH(build_model(packing, scenario, "test"),
                      Catch::Contains("mm, allowed: ") && Catch::Contains("mm with element.precision = 'mixed'"));
  }
}
