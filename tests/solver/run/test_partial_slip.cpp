// Two elastic caps pressed together and dragged to and fro: partial slip (Cattaneo 1938, Mindlin 1949).

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/partial_slip.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem::test;

// Three elements in the contact's radius: forces were 2 % (out) and 4 % (back) of mu P off, the loss 13 %. With four
// (n = 18, three times the work) it was 1.6 %, 2.2 % and 3 %. The theory leaves out that normal and tangential slip are
// coupled.
TEST_CASE(
    "two caps that are dragged slip from the edge of their contact inwards, as in the theory of Cattaneo and Mindlin") {
  const partial_slip::Errors errors = partial_slip::errors({.n = 14}, 0.3);
  CAPTURE(errors.out, errors.back, errors.loss, errors.amplitude);
  CHECK(std::abs(errors.other_share) < 0.08); // and so little it is
  REQUIRE(errors.amplitude > 0.7);
  CHECK(std::abs(errors.out) < 0.04);
  CHECK(std::abs(errors.back) < 0.05);
  CHECK(std::abs(errors.loss) < 0.16); // a small difference of two curves
}

// Four elements in the contact's radius, plain tetrahedra: 1.9 %, 2.6 % and 1.7 % were measured.
TEST_CASE("with four elements across the contact's radius two caps dissipate in a cycle what Mindlin's theory gives, "
          "within 3 %") {
  const partial_slip::Errors errors = partial_slip::errors({.n = 18, .element = mpfem::ElementType::tet4}, 0.3);
  CAPTURE(errors.out, errors.back, errors.loss, errors.amplitude, errors.other_share);
  REQUIRE(errors.amplitude > 0.7);
  CHECK(std::abs(errors.out) < 0.03);
  CHECK(std::abs(errors.back) < 0.03);
  CHECK(std::abs(errors.loss) < 0.03);
}

// Two elements in the contact's radius: -2.3, -5.2 and +21 % were measured, -2.3, -5.2 and +26 % with facets.
TEST_CASE("two caps that touch by their smooth surface slip partially as those that touch by facets") {
  const partial_slip::Errors errors = partial_slip::errors({.n = 10, .surface = mpfem::ContactSurface::smooth}, 0.3);
  CAPTURE(errors.out, errors.back, errors.loss, errors.amplitude);
  REQUIRE(errors.amplitude > 0.7);
  CHECK(std::abs(errors.out) < 0.03);
  CHECK(std::abs(errors.back) < 0.06);
  CHECK(std::abs(errors.loss) < 0.3);
}

// Mindlin and Deresiewicz (1953): every ring of the contact has the ratio of the whole. What yields besides the contact
// leaves 0.78 and at most 0.85 of friction's limit. Of the work of the shear force 5e-4 were lost, with half of that
// shear 5e-7; above the limit 14 %.
TEST_CASE("two caps that come together obliquely, their shear force always below friction's limit, slip nowhere") {
  for (const mpfem::ContactSurface surface : {mpfem::ContactSurface::facets, mpfem::ContactSurface::smooth}) {
    const partial_slip::Oblique sticks = partial_slip::press_obliquely({.n = 10, .surface = surface}, 0.3, 0.9),
                                slides = partial_slip::press_obliquely({.n = 10, .surface = surface}, 0.3, 1.5);
    CAPTURE(sticks.push, sticks.shear / sticks.push, sticks.steepest, sticks.lost / sticks.sheared);
    CAPTURE(slides.push, slides.shear / slides.push, slides.steepest, slides.lost / slides.sheared);
    CHECK(sticks.steepest < 0.3);
    CHECK(sticks.shear > 0.2 * sticks.push);
    CHECK(sticks.lost < 1e-3 * sticks.sheared);
    CHECK(slides.lost > 0.1 * slides.sheared);
    CHECK(within(slides.shear, 0.3 * slides.push, 0.02));
  }
}
