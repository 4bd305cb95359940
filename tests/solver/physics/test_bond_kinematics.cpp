// The bond of one contact point: where it is attached, what it stores, what breaking it takes.

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/contact_point.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

BondLaw law_of(double tensile, double shear) {
  return {.stiffness = 0, .tensile_strength = tensile, .shear_strength = shear, .fracture_energy = 40};
}

/// A point that has bonded a little inside its facet.
ContactPoint bonded_point(const BondLaw& law) {
  ContactPoint point;
  point.law = law;
  point.node = {0.25, 0.25, -1e-3};
  point.evaluate();
  REQUIRE(point.bond.intact());
  return point;
}

/// Work (mJ) against the forces on the node, along a straight way in many steps, by the trapezoidal rule.
double work_to(ContactPoint& point, const Vector3<double>& end, int steps) {
  const Vector3<double> start = point.node, way = (1.0 / steps) * (end - start);
  double work = 0;
  Vector3<double> before = point.evaluate().node;
  for (int i = 1; i <= steps; ++i) {
    point.node = start + (1.0 * i / steps) * (end - start);
    const Vector3<double> now = point.evaluate().node;
    work -= 0.5 * dot(before + now, way);
    before = now;
  }
  return work;
}

} // namespace

TEST_CASE("an undamaged bond returns all work along a closed path through opening, sliding and closing") {
  for (const double penalty_ratio : {0.0, 0.2, 1.0, 5.0}) { // 0: its own stiffness
    BondLaw law = law_of(1e6, 1e6);
    law.stiffness = penalty_ratio == 0 ? 120 : 0;
    law.penalty_ratio = penalty_ratio;
    ContactPoint point = bonded_point(law);
    const Vector3<double> start = point.node;
    double work = 0;
    for (const Vector3<double>& corner :
         {Vector3<double>{0.25, 0.25, 0.02}, Vector3<double>{0.3, 0.2, 0.02}, Vector3<double>{0.3, 0.2, -0.01}, start})
      work += work_to(point, corner, 1000);
    CHECK(point.bond.state.initiation == 0);
    point.node = {0.3, 0.2, 0.02};
    // Forces are linear in the positions, but for the one step of 1000 each way in which the gap closes, where they
    // have a kink if the stiffnesses differ: (1/1000)^2 of the energy, times their ratio.
    const double error_of_steps = penalty_ratio == 1 ? 1e-9 : 1e-5;
    CHECK(std::abs(work) < error_of_steps * point.evaluate().energy);
  }
}

TEST_CASE("the stiffness of a bond acts on opening and sliding, the penalty alone against closing") {
  for (const double stiffness : {10.0, 50.0, 400.0}) { // the penalty is 50
    BondLaw law = law_of(1e6, 1e6);
    law.stiffness = stiffness;
    ContactPoint point = bonded_point(law);
    const double area = point.area;
    point.node = {0.25, 0.25, 0.02};
    CHECK(within(point.evaluate().node.z, -stiffness * area * 0.02, 1e-9));
    point.node = {0.28, 0.25, 0};
    CHECK(within(point.evaluate().node.x, -stiffness * area * 0.03, 1e-9));
    point.node = {0.25, 0.25, -0.02};
    CHECK(within(point.evaluate().node.z, point.stiffness * area * 0.02, 1e-9));
  }
}

TEST_CASE(
    "the work done on a closed point is its stored energy plus what damage dissipates, whatever the bond's stiffness") {
  for (const double stiffness : {20.0, 50.0, 400.0}) {
    BondLaw law = law_of(25, 18);
    law.stiffness = stiffness;
    ContactPoint point = bonded_point(law);
    const double start = point.evaluate().energy;
    // Far enough to spend half of the fracture energy in sliding, held closed, and back in depth.
    for (Vector3<double>& x : point.x) x = {20 * x.x - 8, 20 * x.y - 8, 0};
    point.bond.weight1 = point.bond.weight2 = 8.25 / 20;
    const double work = work_to(point, {1.75, 0.25, -0.02}, 200000) + work_to(point, {1.75, 0.25, -1e-3}, 1000);
    const double spent = point.area * damage_dissipation(law, point.bond.state);
    REQUIRE(spent > 0.1 * point.area * law.fracture_energy);
    CHECK(within(work, point.evaluate().energy - start + spent, 1e-4)); // 200,000 steps over a softening of some mm
  }
}

TEST_CASE("turning a bonded point with its facet turns its force and leaves its energy") {
  ContactPoint point = bonded_point(law_of(1e6, 1e6));
  point.node = {0.27, 0.22, 0.015};
  const PointForces before = point.evaluate();
  const auto turned = [](const Vector3<double>& v) { return Vector3<double>{v.y, v.z, v.x}; }; // about (1, 1, 1)
  point.node = turned(point.node);
  for (Vector3<double>& x : point.x) x = turned(x);
  const PointForces after = point.evaluate();
  CHECK(within(after.energy, before.energy, rounding));
  CHECK(norm(after.node - turned(before.node)) < rounding * norm(before.node));
}

TEST_CASE("pulling a bond apart takes the fracture energy of its area, opening or sliding") {
  for (const Vector3<double>& end : {Vector3<double>{0.25, 0.25, 60}, Vector3<double>{0.25, -60, 1e-6}}) {
    BondLaw law = law_of(25, 18);
    ContactPoint point = bonded_point(law);
    for (Vector3<double>& x : point.x) x = {900 * x.x - 300, 900 * x.y - 300, 0}; // the node stays above the facet
    const double weight = 300.25 / 900;
    point.bond.weight1 = point.bond.weight2 = weight;
    point.node = {0.25, 0.25, 0};
    const double work = work_to(point, end, 200000);
    law = law_at_point(law, point.stiffness);
    CHECK_FALSE(point.bond.intact());
    CHECK(within(work, point.area * law.fracture_energy, 1e-4)); // 200,000 steps over a softening of some mm
    CHECK(within(damage_dissipation(law, point.bond.state), law.fracture_energy, rounding));
  }
}

TEST_CASE("forces of a bonded point add up to no force and no moment, open and closed") {
  for (const double z : {0.02, -0.01}) {
    ContactPoint point = bonded_point(law_of(1e6, 1e6));
    point.node = {0.31, 0.18, z};
    const PointForces f = point.evaluate();
    Vector3<double> force = f.node, moment = cross(point.node, f.node);
    for (int c = 0; c < 3; ++c) force = force + f.facet[c], moment = moment + cross(point.x[c], f.facet[c]);
    REQUIRE(norm(f.node) > 0);
    CHECK(norm(force) < rounding * norm(f.node));
    CHECK(norm(moment) < rounding * norm(f.node));
  }
}
