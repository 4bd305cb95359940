// Two elastic caps pressed together and dragged to and fro: partial slip (Cattaneo 1938, Mindlin 1949).

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/partial_slip.hpp"

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
