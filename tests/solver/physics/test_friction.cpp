// Coulomb friction of one contact point: sticking, slip, what is stored and lost, alone and beside a bond.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "tests/support/contact_point.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double mu = 0.3;
/// Tangential displacements of some 1e-4 mm are differences of places that are up to 10 mm from a corner of their
/// facet.
constexpr double of_places = 1e-11;

/// A point with friction, `depth` (mm) inside a facet that is some millimetres wide.
ContactPoint pressed_point(double depth) {
  ContactPoint point;
  for (Vector3<double>& x : point.x) x = {10 * x.x - 4, 10 * x.y - 4, 0};
  point.friction = mu;
  point.node = {0, 0, -depth};
  point.evaluate();
  return point;
}

/// Largest frequency squared of a point with the masses by which its springs' bounds are 1 in all, by the stiffness
/// that differences of its forces give. `bound` (N/mm): of the node and the three corners. History is frozen.
double squared_frequency_over_bound(const ContactPoint& point, const std::array<double, 4>& bound) {
  constexpr double step = 1e-8; // mm; tangential displacements are some 1e-4 mm
  Eigen::Matrix<double, 12, 12> stiffness;
  const auto forces_moved_by = [&](int column, double by) {
    ContactPoint moved = point;
    Vector3<double>& x = column < 3 ? moved.node : moved.x[column / 3 - 1];
    (column % 3 == 0 ? x.x : column % 3 == 1 ? x.y : x.z) += by;
    const PointForces f = moved.evaluate();
    Eigen::Matrix<double, 12, 1> all;
    all << f.node.x, f.node.y, f.node.z, f.facet[0].x, f.facet[0].y, f.facet[0].z, f.facet[1].x, f.facet[1].y,
        f.facet[1].z, f.facet[2].x, f.facet[2].y, f.facet[2].z;
    return all;
  };
  for (int column = 0; column < 12; ++column) {
    stiffness.col(column) = -(forces_moved_by(column, step) - forces_moved_by(column, -step)) / (2 * step);
  }
  for (int row = 0; row < 12; ++row) stiffness.row(row) /= bound[static_cast<std::size_t>(row / 3)];
  return Eigen::EigenSolver<Eigen::Matrix<double, 12, 12>>(stiffness, false).eigenvalues().real().maxCoeff();
}

double tangential(const PointForces& forces) {
  return std::hypot(forces.node.x, forces.node.y);
}

/// Moves a point to `end` in steps. Returns the work (mJ) against the forces on its node, by the trapezoidal rule.
double work_of_moving_to(ContactPoint& point, const Vector3<double>& end, int steps) {
  const Vector3<double> start = point.node;
  double work = 0;
  Vector3<double> force = point.evaluate().node, place = start;
  for (int i = 1; i <= steps; ++i) {
    point.node = start + (1.0 * i / steps) * (end - start);
    const Vector3<double> now = point.evaluate().node;
    work -= 0.5 * dot(force + now, point.node - place);
    force = now, place = point.node;
  }
  return work;
}

} // namespace

TEST_CASE("a closed point sticks with the stiffness of the penalty, and slides at mu times its normal force") {
  const double depth = 1e-3;
  ContactPoint point = pressed_point(depth);
  const double k = point.stiffness * point.area;
  point.node.x = 0.9 * mu * depth;
  CHECK(within(tangential(point.evaluate()), k * 0.9 * mu * depth, of_places));
  CHECK(std::abs(point.rubbed) < rounding * k * depth * depth);
  for (const double x : {1.1, 5.0, 40.0}) {
    point.node.x = x * mu * depth;
    const PointForces forces = point.evaluate();
    CHECK(within(tangential(forces), mu * forces.node.z, of_places));
    CHECK(within(forces.node.z, k * depth, of_places));
  }
  point.node = {point.node.x, point.node.y, -0.5 * depth}; // the push halves, and so does the bound
  CHECK(within(tangential(point.evaluate()), 0.5 * mu * k * depth, of_places));
}

TEST_CASE("a point that sticks keeps its anchor bitwise while its normal force changes above its bound") {
  ContactPoint point = pressed_point(1e-3);
  point.node.x = 0.5 * mu * 1e-3;
  point.evaluate();
  const PointFriction before = point.point_friction;
  for (int i = 0; i < 100000; ++i) {
    point.node.z = -1e-3 * (1 + 0.45 * std::sin(0.1 * i));
    point.evaluate();
  }
  CHECK(point.point_friction.weight1 == before.weight1);
  CHECK(point.point_friction.weight2 == before.weight2);
}

TEST_CASE(
    "a cycle of sliding under constant normal force dissipates 4 mu N (U - mu N/k), whatever the length of a step") {
  const double depth = 1e-3, amplitude = 2e-3;
  for (const int steps : {50, 500}) {
    ContactPoint point = pressed_point(depth);
    const double k = point.stiffness * point.area;
    work_of_moving_to(point, {amplitude, 0, -depth}, steps);
    const double before = point.rubbed;
    const double work = work_of_moving_to(point, {-amplitude, 0, -depth}, 2 * steps) +
                        work_of_moving_to(point, {amplitude, 0, -depth}, 2 * steps);
    const double expected = 4 * mu * k * depth * (amplitude - mu * depth);
    CHECK(within(point.rubbed - before, expected, 1e-9)); // 5 mm of facet in numbers of 16 digits
    // The step in which a point begins to slide is the one whose work is not that of a straight line.
    CHECK(within(work, expected, 20.0 / (steps * steps)));
  }
}

TEST_CASE("along a random path under varying normal force the work is what is stored and dissipated, and friction "
          "never releases energy") {
  // The anchor slips along the tangential displacement that is left, of length L = mu g. Both forces of the trapezoidal
  // rule do work on it: k (L + e.n) times the slip, with the displacement e before and its direction n now. This is
  // negative only if e.n < -L, and then the node has moved by more than 2 L in one step.
  ContactPoint point = pressed_point(1e-3);
  std::mt19937 random(1);
  std::normal_distribution<double> step(0, 2e-5);
  const double start = point.evaluate().energy;
  double work = 0;
  int sliding = 0, jumps = 0;
  Vector3<double> force = point.evaluate().node, place = point.node;
  for (int i = 0; i < 20000; ++i) {
    point.node = {place.x + step(random), place.y + step(random), -1e-3 * (1 + 0.9 * std::sin(i / 300.0))};
    const double rubbed = point.rubbed;
    const Vector3<double> now = point.evaluate().node, way = point.node - place;
    const double lost = point.rubbed - rubbed;
    if (std::hypot(way.x, way.y) > 2 * mu * -point.node.z)
      ++jumps;
    else
      CHECK(lost >= 0);
    sliding += lost > 0 ? 1 : 0;
    work -= 0.5 * dot(force + now, way);
    force = now, place = point.node;
  }
  REQUIRE(point.rubbed > 0.1 * std::abs(work));
  CHECK(sliding > 1000);
  CHECK(jumps < 1000);
  CHECK(within(work, point.evaluate().energy - start + point.rubbed, 1e-9));
}

TEST_CASE("an open point forgets its anchor, and a closing one is anchored where it closes") {
  ContactPoint point = pressed_point(1e-3);
  point.node.x = 0.5 * mu * 1e-3;
  point.evaluate();
  point.node.z = 1e-4;
  point.evaluate();
  CHECK_FALSE(point.point_friction.exists());
  CHECK(point.rubbed > 0);
  point.node = {0.3, 0.2, -1e-4};
  CHECK(tangential(point.evaluate()) < rounding);
}

TEST_CASE("forces with friction add up to no force and no moment, and turn with the point and its facet") {
  ContactPoint point = pressed_point(1e-3);
  point.node.x = 2e-4;
  for (const double y : {1e-4, 1e-3}) { // sticking, sliding
    point.node.y = y;
    const PointForces before = point.evaluate();
    REQUIRE(tangential(before) > 0.1 * before.node.z);
    Vector3<double> force = before.node, moment = cross(point.node, before.node);
    for (int c = 0; c < 3; ++c) force = force + before.facet[c], moment = moment + cross(point.x[c], before.facet[c]);
    CHECK(norm(force) < 1e-12 * norm(before.node)); // weights of a wide facet
    CHECK(norm(moment) < 1e-12 * norm(before.node));
    ContactPoint turned = point;
    const auto turn = [](const Vector3<double>& v) { return Vector3<double>{v.y, v.z, v.x}; };
    turned.node = turn(turned.node);
    for (Vector3<double>& x : turned.x) x = turn(x);
    const PointForces after = turned.evaluate();
    CHECK(within(after.energy, before.energy, 1e-12));
    CHECK(norm(after.node - turn(before.node)) < 1e-12 * norm(before.node));
  }
}

TEST_CASE("a point that closes obliquely is anchored where it came in, and stores and loses the work of its step") {
  const Vector3<double> corner[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; // outward normal z
  constexpr double k = 2, depth = 0.02, closing = 0.07;
  const Vector3<double> node{0.3, 0.3, -depth}, moved{0.03, 0.04, -closing};
  const ClosestPoint<double> closest = closest_point_on_triangle(node, corner);
  for (const double friction : {10.0, 0.2}) { // sticks, slips
    CAPTURE(friction);
    PointFriction point;
    const FrictionStep step = advance_friction(point, friction_spring(point, friction, k, k),
                                               {node, 0, corner, closest, depth, moved}, corner);
    const double along = 0.05, inside = along * depth / closing, displacement = std::min(inside, friction * depth);
    CHECK(within(std::hypot(step.reach.x, step.reach.y), displacement, 1e-12));
    CHECK(within(step.stored, 0.5 * k * displacement * displacement, 1e-12));
    // Central differences do the work of half the force over the whole step, from rest: also outside.
    CHECK(within(step.stored + step.dissipated, 0.5 * k * displacement * along, 1e-12));
    CHECK(step.dissipated > 0);
  }
}

TEST_CASE("the damaged share of a bond rubs: shear under pressure follows the reference table") {
  for (const auto& row : read_reference("friction_with_damage.csv")) {
    const double energy = std::stod(row[0]), pressure = std::stod(row[1]);
    ContactPoint point;
    point.stiffness = 3.333e6;
    for (Vector3<double>& x : point.x) x = {10 * x.x - 4, 10 * x.y - 4, 0};
    point.law = BondLaw{.tensile_strength = 25, .shear_strength = 25, .fracture_energy = energy};
    point.friction = mu;
    const double depth = pressure / point.stiffness, end = 0.5 * energy;
    point.node = {0, 0, -std::max(depth, 1e-15)}; // a bond forms inside
    const double before = point.evaluate().energy;
    double peak = 0, work = 0, last = 0;
    constexpr int steps = 100000;
    for (int i = 1; i <= steps; ++i) {
      point.node.x = end * i / steps;
      const double traction = -point.evaluate().node.x / point.area;
      work += 0.5 * (last + traction) * end / steps;
      peak = std::max(peak, last = traction);
    }
    INFO("G^c = " << energy << " N/mm, p = " << pressure << " MPa");
    const BondLaw law = law_at_point(*point.law, point.stiffness);
    const double damage = damage_dissipation(law, point.bond.state), friction = point.rubbed / point.area;
    // Both integrations have errors of their steps, which span 0.5 of a micrometre per mm here.
    CHECK(within(damage, energy * std::stod(row[2]), 1e-4));
    CHECK(std::abs(friction - std::stod(row[3])) < 1e-3 * friction + 1e-4 * energy);
    CHECK(within(peak, std::stod(row[4]), 1e-3));
    CHECK(std::abs(last - std::stod(row[5])) < 1e-4 * last + 1e-4);
    CHECK(within(work, damage + friction + (point.evaluate().energy - before) / point.area, 1e-4));
  }
}

TEST_CASE("friction changes nothing at a bonded point that is open or undamaged") {
  for (const double z : {1e-4, -1e-3}) {
    ContactPoint with = pressed_point(1e-3);
    with.point_friction = {};
    with.law = BondLaw{.tensile_strength = 1e6, .shear_strength = 1e6, .fracture_energy = 1e6};
    ContactPoint without = with;
    without.friction = 0;
    for (ContactPoint* point : {&with, &without}) {
      point->evaluate();
      point->node = {2e-3, 1e-3, z};
    }
    const PointForces a = with.evaluate(), b = without.evaluate();
    REQUIRE(tangential(b) > 0);
    CHECK(norm(a.node - b.node) == 0);
    CHECK(a.energy == b.energy);
  }
}

TEST_CASE("every lane of a pack has the slip and the energies of the scalar") {
  using S = NativePack;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  S displacement, largest, before, now, depth;
  for (S* field : {&displacement, &largest, &before, &now, &depth})
    for (int lane = 0; lane < S::lanes; ++lane) field->v[lane] = lane % 3 == 0 ? 0.0 : uniform(random);
  const S left = share_left_by_slip(displacement, largest), kept = share_left_by_new_area(before, now);
  const S stored = stick_energy(before, displacement, depth);
  const S lost = slip_dissipation(Vector3<S>{displacement, largest, depth}, Vector3<S>{now, before, displacement},
                                  Vector3<S>{depth, displacement, now});
  for (int i = 0; i < S::lanes; ++i) {
    CHECK(left[i] == share_left_by_slip(displacement[i], largest[i]));
    CHECK(kept[i] == share_left_by_new_area(before[i], now[i]));
    CHECK(within(stored[i], stick_energy(before[i], displacement[i], depth[i]), rounding));
    CHECK(within(lost[i],
                 slip_dissipation(Vector3<double>{displacement[i], largest[i], depth[i]},
                                  Vector3<double>{now[i], before[i], displacement[i]},
                                  Vector3<double>{depth[i], displacement[i], now[i]}),
                 rounding));
  }
}

TEST_CASE("no state of a rubbing point is stiffer than the bounds of its springs, half damaged bonds included") {
  // The step estimate adds up contact_stiffness_bound of the two records of a point: what is left of the penalty, at
  // the anchor of friction, and the bond at its attachment. Sliding makes the stiffness unsymmetric.
  std::mt19937 random(7);
  std::normal_distribution<double> sidewards(0, 2e-4);
  std::uniform_real_distribution<double> depth(2e-4, 2e-3);
  int half_damaged = 0;
  double largest = 0;
  for (const double ratio : {0.3, 1.0, 2.0})
    for (int trial = 0; trial < 200; ++trial) {
      ContactPoint point = pressed_point(depth(random));
      point.point_friction = {};
      const double b = ratio * point.stiffness, strength = 1e-4 * b; // damage begins at 1e-4 mm
      point.law = BondLaw{.stiffness = b,
                          .tensile_strength = strength,
                          .shear_strength = strength,
                          .fracture_energy = 1e-6 * b / 2,
                          .softening = SofteningLaw::energy};
      for (int i = 0; i < 8; ++i) {
        point.node = point.node + Vector3<double>{sidewards(random), sidewards(random), 0};
        point.evaluate();
      }
      const BondLaw law = law_at_point(*point.law, point.stiffness);
      const double remaining = point.bond.remaining;
      half_damaged += remaining > 0.05 && remaining < 0.95 ? 1 : 0;
      std::array<double, 4> bound{};
      const auto add = [&](double stiffness, double weight1, double weight2) {
        const double weight[3] = {1 - weight1 - weight2, weight1, weight2};
        const double kappa = contact_stiffness_bound(stiffness, weight[0], weight[1], weight[2]);
        bound[0] += kappa;
        for (std::size_t c = 0; c < 3; ++c) bound[c + 1] += std::abs(weight[c]) * kappa;
      };
      const double left = point.bond.intact() ? penalty_left_by_bond(law, point.bond, point.stiffness) : 1.0;
      add(std::abs(left) * point.stiffness * point.area, point.point_friction.weight1, point.point_friction.weight2);
      if (point.bond.intact()) add(remaining * b * point.area, point.bond.weight1, point.bond.weight2);
      largest = std::max(largest, squared_frequency_over_bound(point, bound));
    }
  CHECK(half_damaged > 100);
  // The force turns with the facet, which is a thousand times as wide as the displacement: that much is not in the
  // bound.
  CHECK(largest < 1 + 1e-3);
  CHECK(largest > 0.9);
}
