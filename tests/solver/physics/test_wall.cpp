// A rigid wall against one node.

#include <catch2/catch.hpp>

#include "solver/physics/wall.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("a wall's gap is positive inside the box and negative behind the wall, at both faces") {
  CHECK(within(wall_gap(0.3, 0.1, 1.0), 0.2, rounding));
  CHECK(within(wall_gap(0.05, 0.1, 1.0), -0.05, rounding));
  CHECK(within(wall_gap(0.3, 0.9, -1.0), 0.6, rounding));
  CHECK(within(wall_gap(0.95, 0.9, -1.0), -0.05, rounding));
}

TEST_CASE("a wall pushes a node back with K r A times its depth, and stores the work of that push") {
  constexpr double penalty = 1.5e6, refinement = 2, area = 4e-4; // MPa/mm, 1, mm^2
  for (const double depth : {1e-6, 1e-4, 1e-2}) {
    const double force = wall_force(-depth, penalty, refinement, area);
    CHECK(within(force, penalty * refinement * area * depth, rounding));
    CHECK(within(wall_energy(force, -depth), 0.5 * penalty * refinement * area * depth * depth, rounding));
    // The work of the push from here to a little deeper, by the trapezoidal rule, which is exact for a spring.
    const double deeper = 1.1 * depth, more = wall_force(-deeper, penalty, refinement, area);
    CHECK(within(wall_energy(more, -deeper) - wall_energy(force, -depth), 0.5 * (force + more) * (deeper - depth),
                 accumulated_rounding));
  }
}
