// The velocity update of one node.

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/physics/damping.hpp"
#include "solver/physics/smooth_step.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("without damping the velocity update is v + dt f/m") {
  const DampedUpdate update = damped_update({.step_mean = 2e-9, .step = 2e-9});
  CHECK(update.keep == 1);
  CHECK(update.gain == 2e-9);
  CHECK(update.pull == 0);
  CHECK(within(update.velocity(3, 1e12, 0.5, 100), 3 + 2e-9 * 0.5e12, rounding));
}

TEST_CASE("damping leaves a node alone that moves with the affine velocity field, and slows others towards it") {
  const Advance p{.step_mean = 1e-9, .step = 1e-9, .damping_rate = 1e8, .centre = {1, 2, 3}, .rate = {-50, 20, 0}};
  const DampedUpdate update = damped_update(p);
  const double target = affine_velocity(p, 0, 1.5);
  CHECK(within(target, -25, rounding));
  CHECK(within(update.velocity(target, 1e12, 0, target), target, rounding));
  CHECK(affine_velocity(p, 2, 7) == 0);
  const double after = update.velocity(target + 8, 1e12, 0, target);
  CHECK(after > target);
  CHECK(after < target + 8);
}

TEST_CASE("damping draws towards walls that move all together, as in a die that is lifted") {
  const Advance p{.damping_rate = 1e8, .centre = {1, 2, 3}, .velocity = {0, 0, 40}, .rate = {0, 0, -10}};
  CHECK(affine_velocity(p, 0, 5) == 0);
  CHECK(within(affine_velocity(p, 2, 3), 40, rounding));
  CHECK(within(affine_velocity(p, 2, 5), 20, rounding));
}

TEST_CASE("free motion decays as exp(-c t), with an error of second order in the step") {
  constexpr double rate = 1e6, time = 2e-6; // 1/s, s
  const auto error = [&](int steps) {
    const DampedUpdate update = damped_update({.step_mean = time / steps, .damping_rate = rate});
    double v = 1;
    for (int i = 0; i < steps; ++i) v = update.velocity(v, 1, 0, 0);
    return std::abs(v / std::exp(-rate * time) - 1);
  };
  CHECK(error(1000) < 1e-6);
  CHECK(error(100) / error(200) > 3.9); // second order: a quarter
  CHECK(error(100) / error(200) < 4.1);
}

TEST_CASE("the force for a wanted velocity gives that velocity") {
  const DampedUpdate update = damped_update({.step_mean = 1e-9, .step = 1e-9, .damping_rate = 3e7});
  for (const double after : {-700.0, 0.0, 12.5, 4000.0}) {
    const double force = update.force(250, after, 1e12, 40);
    CHECK(std::abs(update.velocity(250, 1e12, force, 40) - after) < rounding * 4000);
  }
}

TEST_CASE("a smooth step goes from 0 to 1, is flat at both ends and beyond them, and symmetric") {
  CHECK(smooth_step(0) == 0);
  CHECK(smooth_step(1) == 1);
  CHECK(smooth_step(-3) == 0);
  CHECK(smooth_step(5) == 1);
  CHECK(smooth_step(0.5) == 0.5);
  CHECK(smooth_step(1e-4) < 4e-8); // no slope: 3 s^2
  CHECK(1 - smooth_step(1 - 1e-4) < 4e-8);
  for (const double s : {0.1, 0.25, 0.4}) CHECK(within(smooth_step(s) + smooth_step(1 - s), 1, rounding));
}
