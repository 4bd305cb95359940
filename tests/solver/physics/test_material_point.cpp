// The constitutive step against closed forms and the independent numbers in tests/reference/single_element.csv.

#include <random>

#include <catch2/catch.hpp>

#include "tests/support/material_point.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

const ElasticModuli moduli = elastic_moduli(5000, 0.3);
const PowerLaw table1{25, 125, 0.3};

struct ReferenceRow {
  double control, first, second, shear, plastic_strain;
};

std::vector<ReferenceRow> reference(const std::string& test) {
  std::vector<ReferenceRow> rows;
  const auto number = [](const std::string& text) { return text.empty() ? 0.0 : std::stod(text); };
  for (const auto& row : read_reference("single_element.csv"))
    if (row[0].starts_with(test))
      rows.push_back({number(row[1]), number(row[2]), number(row[3]), number(row[4]), number(row[5])});
  REQUIRE(!rows.empty());
  return rows;
}

} // namespace

TEST_CASE("uniaxial stress follows the exact power-law curve from zero plastic strain") {
  // Reference: sigma solves eps = sigma/E + ((sigma - 25)/125)^(1/0.3) (logarithmic strain, small elastic part).
  // Backward Euler lies on the flow curve at every step, so monotonic loading carries no error of the step size.
  for (const auto& row : reference("uniaxial_stress")) {
    for (const int steps : {1, 7, 400}) {
      MaterialPoint point(table1, moduli);
      for (int i = 0; i < steps; ++i) point.step_uniaxial_stress(row.control / steps);
      CAPTURE(row.control, steps);
      if (row.plastic_strain > 0) REQUIRE(point.hardening.plastic_strain > 0);
      CHECK(std::abs(point.stress_xx() - row.first) < 1e-8 * row.first);
      CHECK(std::abs(point.hardening.plastic_strain - row.plastic_strain) < 1e-10);
    }
  }
}

TEST_CASE("uniaxial strain compression follows the reference to large strain") {
  for (const auto& row : reference("uniaxial_strain_compression")) {
    MaterialPoint point(table1, moduli);
    Gradient gradient;
    const int steps = 50;
    gradient.h[0][0] = -row.control / steps;
    for (int i = 0; i < steps; ++i) point.step(gradient);
    CAPTURE(row.control);
    CHECK(std::abs(-point.stress_xx() - row.first) < 1e-8 * row.first);
    CHECK(std::abs(-point.stress_yy() - row.second) < 1e-8 * row.first);
  }
}

TEST_CASE("hydrostatic response is exactly -K ln J") {
  for (const auto& row : reference("hydrostatic")) {
    CHECK(within(-mean_stress(moduli, row.control), row.first, 1e-12));
  }
}

TEST_CASE("elastic Jaumann simple shear converges to G sin gamma with the second order") {
  // sigma_xy = G sin gamma, sigma_xx = -sigma_yy = G (1 - cos gamma). One half of the strain increment is added before
  // the rotation and one half after; the whole of it on one side would be an error of half a step's rotation, of the
  // first order.
  double previous_error = 0;
  for (const int steps : {250, 500, 1000}) {
    double error = 0;
    for (const auto& row : reference("jaumann_elastic_shear")) {
      MaterialPoint point(ElasticLaw{}, moduli);
      Gradient gradient;
      gradient.h[0][1] = row.control / steps;
      for (int i = 0; i < steps; ++i) point.step(gradient);
      error = std::max({error, std::abs(point.deviator.xy - row.shear) / moduli.shear,
                        std::abs(point.stress_xx() - row.first) / moduli.shear,
                        std::abs(point.stress_yy() - row.second) / moduli.shear});
    }
    if (previous_error > 0) CHECK(previous_error / error == Approx(4.0).epsilon(0.01));
    previous_error = error;
  }
  CHECK(previous_error < 2e-6);
}

TEST_CASE("plastic Jaumann simple shear agrees with the independent integration") {
  for (const auto& row : reference("jaumann_plastic_shear")) {
    MaterialPoint point(table1, moduli);
    Gradient gradient;
    const int steps = 8000;
    gradient.h[0][1] = row.control / steps;
    for (int i = 0; i < steps; ++i) point.step(gradient);
    CAPTURE(row.control);
    // The reference is rounded to four decimals and integrated with the same number of steps.
    CHECK(std::abs(point.deviator.xy - row.shear) < 2e-4 * row.shear);
    CHECK(std::abs(point.stress_xx() - row.first) < 5e-3 * row.shear);
    CHECK(std::abs(point.hardening.plastic_strain - row.plastic_strain) < 1e-4);
  }
}

TEST_CASE("plastic work is the area under the flow curve") {
  MaterialPoint point(table1, moduli);
  for (int i = 0; i < 4000; ++i) point.step_uniaxial_stress(0.3 / 4000);
  const double e = point.hardening.plastic_strain;
  const double exact = 25 * e + 125 * std::pow(e, 1.3) / 1.3;
  CHECK(within(point.plastic_work, exact, 2e-5)); // trapezoids under a concave curve with infinite initial slope
}

TEST_CASE("a full turn in steps leaves the stress exactly unchanged") {
  const Deviator<double> start{12, -7, 3, 5, -9};
  for (const int steps : {4, 36, 1000}) {
    // The Cayley rotation by a vector w turns by 2 atan(|w|/2): choose w for an exact fraction of a turn.
    const double w = 2 * std::tan(M_PI / steps);
    const Vector3<double> axis{w * 2 / 7, w * 3 / 7, w * 6 / 7};
    Deviator<double> s = start;
    for (int i = 0; i < steps; ++i) s = rotated(s, axis);
    CHECK(std::abs(s.xx - start.xx) < 1e-12 * 12 * steps);
    CHECK(std::abs(s.zx - start.zx) < 1e-12 * 12 * steps);
    CHECK(within(von_mises(s), von_mises(start), rounding * steps));
  }
}

TEST_CASE("the return map solves its equation for any increment, from zero plastic strain") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const double three_shear = 3 * moduli.shear;
  for (int i = 0; i < 20000; ++i) {
    const PowerLaw law{std::pow(10, -1 + 3 * uniform(random)), std::pow(10, 3 * uniform(random)),
                       0.05 + 0.95 * uniform(random)};
    const double strain = i % 4 == 0 ? 0.0 : std::pow(10, -12 + 12 * uniform(random));
    const HardeningState<double> old{law.yield_stress + law.coefficient * std::pow(strain, law.exponent), strain};
    const double excess = old.flow_stress * std::pow(10, -10 + 12 * uniform(random));
    const double trial = old.flow_stress + excess;
    const auto end = law.end_of_increment(trial, old, three_shear);
    CAPTURE(law.yield_stress, law.coefficient, law.exponent, strain, excess);
    REQUIRE(end.plastic_strain >= old.plastic_strain);
    REQUIRE(end.flow_stress <= trial * (1 + 1e-14));
    const double residual = three_shear * (end.plastic_strain - strain) + end.flow_stress - trial;
    CHECK(std::abs(residual) < 1e-12 * trial + 1e-13 * three_shear * strain);
    // The state lies on the flow curve. Where eps_p is far below 1e-16 of what 3G eps_p can resolve, compare stresses.
    const double curve = law.yield_stress + law.coefficient * std::pow(end.plastic_strain, law.exponent);
    const double strain_rounding = 4e-16 * (trial / three_shear + strain) / std::max(end.plastic_strain, 1e-300);
    CHECK(std::abs(end.flow_stress - curve) < (1e-11 + 10 * strain_rounding) * trial);
  }
}

TEST_CASE("the total-strain law starts at its intersection with the elastic line and follows n eps^p") {
  const TotalStrainLaw law{160, 0.4, 5000};
  CHECK(within(law.initial_flow_stress(), 16.127, 1e-4)); // value from Eq. 8 worked out by hand
  MaterialPoint point(law, moduli);
  for (int i = 0; i < 50; ++i) point.step_uniaxial_stress(0.2 / 50);
  CHECK(within(point.stress_xx(), 160 * std::pow(0.2, 0.4), 1e-9));
}

TEST_CASE("the table law follows its points and stays constant beyond the last") {
  TableLaw law;
  law.points = 3;
  law.strain = {0, 0.01, 0.1};
  law.stress = {20, 40, 60};
  MaterialPoint point(law, moduli);
  for (int i = 0; i < 100; ++i) point.step_uniaxial_stress(0.005 / 100);
  double e = point.hardening.plastic_strain;
  REQUIRE(e > 0);
  CHECK(within(point.stress_xx(), 20 + 2000 * e, 1e-9));
  for (int i = 0; i < 3; ++i) point.step_uniaxial_stress(0.1);
  CHECK(within(point.stress_xx(), 60, 1e-9));
}

TEST_CASE("points that do not yield keep their state and do not affect the return of others in their pack") {
  using S = NativePack;
  const PowerLaw law{25, 125, 0.3};
  for (const double strain : {1e-6, 1e-3, 0.1}) {
    const double flow = 25 + 125 * std::pow(strain, 0.3);
    const HardeningState<S> all{S(flow), S(strain)};
    const S trial = all.flow_stress + S(1e-3 * strain * 5000); // a small increment: no iterations
    const HardeningState<S> expected = law.end_of_increment(trial, all, 3 * moduli.shear);
    HardeningState<S> mixed = all;
    S mixed_trial = trial;
    for (int lane = 1; lane < S::lanes; ++lane)
      mixed.plastic_strain.v[lane] = 0, mixed.flow_stress.v[lane] = mixed_trial.v[lane] = 25;
    const HardeningState<S> end = law.end_of_increment(mixed_trial, mixed, 3 * moduli.shear);
    CHECK(end.flow_stress[0] == expected.flow_stress[0]);
    CHECK(end.plastic_strain[0] == expected.plastic_strain[0]);
    for (int lane = 1; lane < S::lanes; ++lane) {
      CHECK(end.flow_stress[lane] == 25);
      CHECK(end.plastic_strain[lane] == 0);
    }
  }
}

TEST_CASE("every lane of a pack gives the scalar answer") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  using S = NativePack;
  constexpr int W = S::lanes;
  const auto compare = [&](const auto& law) {
    for (int repeat = 0; repeat < 300; ++repeat) {
      Deviator<S> s;
      HardeningState<S> hardening;
      Increment<S> increment;
      S* const fields[] = {&s.xx,
                           &s.yy,
                           &s.xy,
                           &s.yz,
                           &s.zx,
                           &increment.strain.xx,
                           &increment.strain.yy,
                           &increment.strain.zz,
                           &increment.strain.xy,
                           &increment.strain.yz,
                           &increment.strain.zx,
                           &increment.rotation.x,
                           &increment.rotation.y,
                           &increment.rotation.z};
      const double size = std::pow(10, -5 + 2 * (uniform(random) + 1));
      for (int lane = 0; lane < W; ++lane) {
        for (int k = 0; k < 14; ++k) fields[k]->v[lane] = uniform(random) * (k < 5 ? 15.0 : size);
        const double strain = lane % 2 == 0 ? 0.0 : std::abs(uniform(random)) * 0.1;
        hardening.plastic_strain.v[lane] = strain;
        hardening.flow_stress.v[lane] = law.yield_stress + law.coefficient * std::pow(strain, law.exponent);
      }
      const auto pack = update_deviator(law, moduli, s, hardening, increment);
      for (int lane = 0; lane < W; ++lane) {
        const auto scalar = update_deviator(
            law, moduli, Deviator<double>{s.xx[lane], s.yy[lane], s.xy[lane], s.yz[lane], s.zx[lane]},
            HardeningState<double>{hardening.flow_stress[lane], hardening.plastic_strain[lane]},
            Increment<double>{{increment.strain.xx[lane], increment.strain.yy[lane], increment.strain.zz[lane],
                               increment.strain.xy[lane], increment.strain.yz[lane], increment.strain.zx[lane]},
                              {increment.rotation.x[lane], increment.rotation.y[lane], increment.rotation.z[lane]}});
        CHECK(std::abs(pack.deviator.xx[lane] - scalar.deviator.xx) < 1e-11 * 20);
        CHECK(std::abs(pack.deviator.zx[lane] - scalar.deviator.zx) < 1e-11 * 20);
        CHECK(std::abs(pack.hardening.flow_stress[lane] - scalar.hardening.flow_stress) < 1e-9);
        CHECK(std::abs(pack.hardening.plastic_strain[lane] - scalar.hardening.plastic_strain) < 1e-13);
      }
    }
  };
  compare(table1);
}
