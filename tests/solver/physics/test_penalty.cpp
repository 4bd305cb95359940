// The penalty at one contact point: a potential, action and reaction, and its bound of the frequency.

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "tests/support/contact_point.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Points beneath the facet: under its interior, its edges and its corners.
std::vector<Vector3<double>> points_inside() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> across(-0.3, 1.2), depth(-0.2, -0.01);
  std::vector<Vector3<double>> points;
  for (int i = 0; i < 200; ++i) points.push_back({across(random), across(random), depth(random)});
  return points;
}

} // namespace

TEST_CASE("the penalty of two grains is that of two springs in series, half of it in each pass") {
  CHECK(within(pass_stiffness(30, 30), 15, rounding));
  CHECK(within(2 * pass_stiffness(30, 30), 30, rounding));
  CHECK(within(1 / pass_stiffness(10, 90), 1.0 / 10 + 1.0 / 90, rounding));
  CHECK(pass_stiffness(10, 90) == pass_stiffness(90, 10));
  CHECK(within(penalty_stiffness(10, 5000, 0.03), 10 * 5000 / 0.03, rounding));
}

TEST_CASE("the force of a contact point is minus the gradient of its energy, beneath faces, edges and corners") {
  constexpr double step = 1e-6; // mm: of differences whose error is then about 1e-8
  for (const Vector3<double>& x : points_inside()) {
    ContactPoint point;
    const auto energy_at = [&](double dx, double dy, double dz) {
      point.node = {x.x + dx, x.y + dy, x.z + dz};
      return point.evaluate().energy;
    };
    const Vector3<double> gradient{(energy_at(step, 0, 0) - energy_at(-step, 0, 0)) / (2 * step),
                                   (energy_at(0, step, 0) - energy_at(0, -step, 0)) / (2 * step),
                                   (energy_at(0, 0, step) - energy_at(0, 0, -step)) / (2 * step)};
    point.node = x;
    const Vector3<double> force = point.evaluate().node;
    REQUIRE(norm(force) > 0);
    CHECK(norm(force + gradient) < 1e-6 * norm(force));
  }
}

TEST_CASE("force and reactions of a contact point add up to no force and no moment") {
  for (const Vector3<double>& x : points_inside()) {
    ContactPoint point;
    point.node = x;
    const PointForces f = point.evaluate();
    Vector3<double> force = f.node, moment = cross(x, f.node);
    for (int c = 0; c < 3; ++c) force = force + f.facet[c], moment = moment + cross(point.x[c], f.facet[c]);
    CHECK(norm(force) < rounding * norm(f.node));
    CHECK(norm(moment) < rounding * norm(f.node)); // lever arms are of the order of 1 mm
  }
}

TEST_CASE("no motion of node and facet stores more in a contact point than the bound of its stiffness") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  double tightest = 0;
  for (int i = 0; i < 2000; ++i) {
    const double k = 2.5, w1 = any(random), w2 = any(random), w[3] = {1 - w1 - w2, w1, w2};
    const double bound = contact_stiffness_bound(k, w[0], w[1], w[2]);
    const double u = any(random), of_facet[3] = {any(random), any(random), any(random)};
    double gap = u, squares = u * u;
    for (int c = 0; c < 3; ++c) gap -= w[c] * of_facet[c], squares += std::abs(w[c]) * of_facet[c] * of_facet[c];
    CHECK(k * gap * gap <= bound * squares * (1 + rounding));
    tightest = std::max(tightest, k * gap * gap / (bound * squares));
  }
  CHECK(tightest > 0.9); // and it is met nearly
  CHECK(within(contact_stiffness_bound(2.5, 0.2, 0.3, 0.5), 5, rounding));
}
