// Contact force against Hertz. The whole table over mesh size: tests/benchmarks/hertz_convergence.cpp, docs/numerics.md.

#include <catch2/catch.hpp>

#include "tests/support/hertz_column.hpp"

using namespace mpfem::test;

namespace {

void check_quasi_static(const ColumnResult& result) {
  CHECK(result.kinetic_over_elastic < 0.01);
  CHECK(std::abs(result.residual_over_work) < 0.01);
  CHECK(std::abs(result.wall_imbalance) < 0.02);
}

} // namespace

// At an approach of 0.04 R the contact's radius is 0.2 R: one element at R/h = 5, two at R/h = 10. Linear tets are too
// stiff under such a gradient; the error falls with the square of h at first.
TEST_CASE("the force of a sphere between planes approaches Hertz as the mesh is refined") {
  const ColumnResult coarse = press_column(1, 5, 0.004, 10), fine = press_column(1, 10, 0.004, 10);
  CAPTURE(coarse.wall_error, fine.wall_error);
  check_quasi_static(coarse);
  check_quasi_static(fine);
  CHECK(coarse.wall_error < 0.25);
  CHECK(fine.wall_error < 0.07);
  CHECK(std::abs(fine.wall_error) < 0.4 * coarse.wall_error);
}

TEST_CASE("the force between two spheres approaches Hertz as the mesh is refined, as that on a plane does") {
  const ColumnResult coarse = press_column(2, 5, 0.004, 10), fine = press_column(2, 7, 0.004, 10);
  CAPTURE(coarse.sphere_error, fine.sphere_error, coarse.wall_error, fine.wall_error);
  check_quasi_static(coarse);
  check_quasi_static(fine);
  CHECK(coarse.sphere_error < 0.25);
  CHECK(fine.sphere_error < 0.15);
  CHECK(std::abs(fine.sphere_error) < 0.6 * coarse.sphere_error);
  // Facets that do not match make a pair a little stiffer than a sphere on a plane, not more than the mesh itself does.
  CHECK(std::abs(fine.sphere_error - fine.wall_error) < 0.06);
}
