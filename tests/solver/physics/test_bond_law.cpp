// The traction-separation law of a bond at one point.

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "solver/physics/bond.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

BondLaw table_1(SofteningLaw softening, double fracture_energy = 0.5) {
  return {3.3e6, 25, 18, fracture_energy, softening, false};
}

/// Work (N/mm) of opening along a direction to `end` (mm) by the trapezoidal rule, in equal steps to `knee` (mm),
/// around the law's peak, and in equal steps from there.
double work_of_opening(const BondLaw& law, double normal, double shear1, double shear2, double knee, double end) {
  constexpr int steps = 100'000;
  BondState state;
  double work = 0, before = 0, last = 0;
  for (int i = 1; i <= 2 * steps; ++i) {
    const double d = i <= steps ? knee * i / steps : knee + (end - knee) * (i - steps) / steps;
    const BondTraction t = bond_traction(law, state, normal * d, shear1 * d, shear2 * d);
    const double along = t.normal * normal + t.shear[0] * shear1 + t.shear[1] * shear2;
    work += 0.5 * (before + along) * (d - last);
    before = along, last = d;
  }
  return work;
}

} // namespace

TEST_CASE("damage of both laws is that of the reference table") {
  // K_N_mm3, T0_MPa, Gc_N_mm, delta_mm, D of the energy law, its T, D of the exponential law, its T
  const auto rows = read_reference("bond_damage.csv");
  REQUIRE(rows.size() > 20);
  for (const auto& row : rows) {
    const auto number = [&row](std::size_t column) { return std::stod(row.at(column)); };
    for (const auto& [softening, column] : {std::pair{SofteningLaw::energy, 4}, {SofteningLaw::exponential, 6}}) {
      const BondLaw law{number(0), number(1), number(1), number(2), softening, false};
      BondState state;
      bond_traction(law, state, number(3), 0, 0);
      // The table's eight digits of the separation leave damage uncertain by as much.
      CHECK(1 - remaining_stiffness(law, state) ==
            Approx(number(static_cast<std::size_t>(column))).epsilon(1e-6).margin(1e-7));
    }
  }
}

TEST_CASE("the area under the curve is the fracture energy, in opening, shear and mixed mode") {
  for (const SofteningLaw softening : softening_laws)
    for (const double g : {0.01, 0.5})
      for (const auto& [n, s, t] :
           {std::tuple{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.6, 0.8}, {0.6, 0.0, 0.8}, {0.8, 0.36, 0.48}}) {
        const BondLaw law = table_1(softening, g);
        // To where the closed form says that all but 1e-9 is spent; steps small enough for the trapezoidal rule.
        const double end = softening == SofteningLaw::exponential ? 21 * g / 18 : std::sqrt(42 * g / law.stiffness);
        const double work = work_of_opening(law, n, s, t, 2e-5, end);
        CHECK(work == Approx(g).epsilon(1e-6));
      }
}

TEST_CASE("what is dissipated and stored does not depend on the steps that led there") {
  for (const SofteningLaw softening : softening_laws) {
    const BondLaw law = table_1(softening, 0.1);
    BondState one, many;
    const double end = 2e-3;
    const BondTraction a = bond_traction(law, one, 0.6 * end, 0.8 * end, 0);
    BondTraction b;
    for (int i = 1; i <= 1000; ++i) b = bond_traction(law, many, 0.6 * end * i / 1000, 0.8 * end * i / 1000, 0);
    CHECK(b.normal == Approx(a.normal).epsilon(1e-9));
    CHECK(damage_dissipation(law, many) == Approx(damage_dissipation(law, one)).epsilon(1e-9));
    CHECK(b.stored == Approx(a.stored).epsilon(1e-9));
    CHECK(damage_dissipation(law, one) + a.stored == Approx(envelope_energy(law, one)).epsilon(1e-12));
  }
}

TEST_CASE("the peak of the exponential law is the strength of its mode") {
  const BondLaw law = table_1(SofteningLaw::exponential);
  for (const auto& [opening, strength] :
       {std::pair{1.0, 25.0}, {0.0, 18.0}, {0.6, 1 / std::sqrt(0.36 / 625 + 0.64 / 324)}}) {
    double peak = 0;
    BondState state;
    const double shear = std::sqrt(1 - opening * opening);
    for (int i = 1; i <= 200000; ++i) {
      const double d = 2e-5 * i / 200000;
      const BondTraction t = bond_traction(law, state, opening * d, shear * d, 0);
      peak = std::max(peak, std::hypot(t.normal, t.shear[0]));
    }
    CHECK(peak == Approx(strength).epsilon(1e-4)); // the step's resolution of the peak
  }
}

TEST_CASE("the energy law exceeds the strength as its closed form says") {
  const BondLaw law = table_1(SofteningLaw::energy, 0.5);
  const double g0 = 0.5 * 25 * 25 / law.stiffness, b = 0.5 - g0;
  BondState state;
  const BondTraction t = bond_traction(law, state, std::sqrt(b / law.stiffness), 0, 0);
  CHECK(t.normal == Approx(std::sqrt(law.stiffness * b) * std::exp(-0.5 + g0 / b)).epsilon(1e-12));
  CHECK(t.normal > 700); // thirty times the strength
}

TEST_CASE("unloading goes to the origin, reloading follows it back, and damage never falls") {
  for (const SofteningLaw softening : softening_laws) {
    const BondLaw law = table_1(softening, 0.1);
    BondState state;
    const BondTraction top = bond_traction(law, state, 1e-3, 0, 0);
    const double remaining = remaining_stiffness(law, state);
    CHECK(remaining < 1);
    CHECK(bond_traction(law, state, 0.5e-3, 0, 0).normal == Approx(0.5 * top.normal).epsilon(1e-12));
    CHECK(bond_traction(law, state, 0, 0, 0).normal == 0);
    CHECK(bond_traction(law, state, 1e-3, 0, 0).normal == Approx(top.normal).epsilon(1e-12));
    CHECK(remaining_stiffness(law, state) == remaining);
  }
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  const BondLaw law = table_1(SofteningLaw::exponential, 0.1);
  BondState state;
  double last = 1, dissipated = 0;
  for (int i = 0; i < 1000; ++i) {
    bond_traction(law, state, uniform(random), uniform(random), uniform(random));
    CHECK(remaining_stiffness(law, state) <= last);
    CHECK(damage_dissipation(law, state) >= dissipated);
    last = remaining_stiffness(law, state);
    dissipated = damage_dissipation(law, state);
  }
}

TEST_CASE("compression leaves damage unchanged and carries no traction of the bond") {
  const BondLaw law = table_1(SofteningLaw::exponential);
  BondState state;
  bond_traction(law, state, 1e-4, 0, 0);
  const BondState before = state;
  const BondTraction t = bond_traction(law, state, -1.0, 0, 0);
  CHECK(t.normal == 0);
  CHECK(t.stored == 0);
  CHECK(state.largest == before.largest);
  CHECK(state.initiation == before.initiation);
}

TEST_CASE("a normal-only bond slides freely") {
  BondLaw law = table_1(SofteningLaw::exponential);
  law.normal_only = true;
  BondState state;
  const BondTraction t = bond_traction(law, state, 1e-6, 1, 1);
  CHECK(t.shear[0] == 0);
  CHECK(t.shear[1] == 0);
  CHECK(within(t.normal, law.stiffness * 1e-6, rounding));
  CHECK(state.initiation == 0);
  bond_traction(law, state, 25 / law.stiffness * 1.0001, 1, 1);
  CHECK(within(state.initiation, 25 / law.stiffness, rounding));
}
