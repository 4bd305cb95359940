// Cross-sections of dies given by triangles.

#include <cmath>

#include <catch2/catch.hpp>

#include "surfaces/prism.hpp"
#include "tests/support/tolerances.hpp"
#include "tests/support/triangle_meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("the cross-section of a prism has the area, perimeter and rectangle of its polygon") {
  const auto hexagon = section_of_prism(welded(moved(prism(regular_polygon(6, 2), -1, 3), {5, -7, 0})), -0.5, 2);
  REQUIRE(hexagon);
  CHECK(within(hexagon->area, 6 * std::sqrt(3.0), 1e-12)); // 3/2 sqrt(3) r^2
  CHECK(within(hexagon->perimeter, 12, 1e-12));
  CHECK(within(hexagon->low[0], 3, 1e-12));
  CHECK(within(hexagon->high[0], 7, 1e-12));
  CHECK(within(hexagon->low[1], -7 - std::sqrt(3.0), 1e-12));
  // The same for one whose ends are where the punches begin, and for a polygon that is not convex.
  const auto l = section_of_prism(welded(prism(l_shape, 0, 1)), 0, 1);
  REQUIRE(l);
  CHECK(within(l->area, 3, 1e-12));
  CHECK(within(l->perimeter, 8, 1e-12));
  // A tube: the space between two prisms.
  const LooseTriangles tube = together(prism({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, 0, 1),
                                       inside_out(moved(prism(unit_square, 0.0, 1.0), {1, 1, 0})));
  const auto ring = section_of_prism(welded(tube), 0.2, 0.8);
  REQUIRE(ring);
  CHECK(within(ring->area, 8, 1e-12));
  CHECK(within(ring->perimeter, 16, 1e-12));
}

TEST_CASE("a surface that is not a prism between the two heights has no cross-section") {
  CHECK_FALSE(section_of_prism(welded(ball(6, 12, 1)), -0.5, 0.5));
  CHECK_FALSE(section_of_prism(welded(unit_cube()), 0.5, 1.5)); // it ends between them
  CHECK_FALSE(section_of_prism(welded(unit_cube()), 2, 3));     // it ends before
  CHECK_FALSE(section_of_prism(welded(inside_out(unit_cube())), 0.2, 0.8));
  const LooseTriangles step = together(prism(unit_square, 0, 1), moved(prism(unit_square, 1, 2), {0.5, 0, 0}));
  CHECK_FALSE(section_of_prism(welded(step), 0.5, 1.5));
  CHECK(section_of_prism(welded(step), 0.1, 0.9));
}
