// The cell that the packing fills.

#include <array>

#include <catch2/catch.hpp>

#include "solver/boundary/cell.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("a cell's lengths, volume and centre follow from its corners") {
  const Cell cell{{-1, 0, 2}, {1, 3, 6}};
  CHECK(cell.lengths() == std::array<double, 3>{2, 3, 4});
  CHECK(cell.longest() == 4);
  CHECK(within(cell.volume(), 24, rounding));
  CHECK(cell.centre(0) == 0);
  CHECK(within(cell.centre(1), 1.5, rounding));
}

TEST_CASE("stretching a cell along an axis multiplies that length and moves neither its centre nor its other faces") {
  Cell cell{{-1, 0, 2}, {1, 3, 6}};
  cell.stretch(2, 0.5);
  CHECK(within(cell.length(2), 2, rounding));
  CHECK(within(cell.centre(2), 4, rounding));
  CHECK(cell.length(0) == 2);
  CHECK(cell.length(1) == 3);
}

TEST_CASE("both faces across an axis move inwards by the distance given, outwards where it is negative") {
  Cell cell{{-1, 0, 2}, {1, 3, 6}};
  cell.move_inwards(1, 0.5);
  CHECK(within(cell.low[1], 0.5, rounding));
  CHECK(within(cell.high[1], 2.5, rounding));
  cell.move_inwards(1, -1);
  CHECK(within(cell.length(1), 4, rounding));
}
