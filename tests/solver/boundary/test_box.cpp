// The box: the forces on its walls, and walls that leave and return.

#include <array>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/boundary/box.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

const Cell unit_cell{.high = {1, 1, 1}};
constexpr std::array<bool, 3> none{}, lateral{true, true, false};

} // namespace

TEST_CASE("the stress of a face is its force over its present area, and the mean is that of all six") {
  Box box({{0, 0, 0}, {1, 2, 4}}, none);
  box.take_loads({8, 8, 4, 4, 2, 6}, {});
  const auto stress = box.stress();
  CHECK(within(stress[0], 1, rounding));
  CHECK(within(stress[2], 1, rounding));
  CHECK(within(stress[4], 1, rounding));
  CHECK(within(stress[5], 3, rounding));
  CHECK(within(box.mean_stress(), 8.0 / 6, rounding));
  CHECK(within(box.axis_force()[2], 4, rounding));
}

TEST_CASE("the work of a wall in a step is the mean of its forces before and after times its displacement") {
  Box box(unit_cell, none);
  box.take_loads({10, 0, 0, 0, 0, 0}, {});
  Cell next = box.cell();
  next.move_inwards(0, 0.01);
  box.move_to(next);
  const auto work = box.take_loads({20, 4, 0, 0, 0, 0}, {});
  CHECK(within(work[0], 0.5 * (10 + 20) * 0.01, rounding));
  CHECK(within(work[1], 0.5 * (0 + 4) * 0.01, rounding));
  for (std::size_t side = 2; side < 6; ++side) CHECK(work[side] == 0);
  CHECK(box.take_loads({20, 4, 0, 0, 0, 0}, {})[0] == 0); // nothing has moved since
}

TEST_CASE("faces without walls bear what grips pull, and do no work as walls") {
  Box box(unit_cell, {true, true, true});
  box.take_loads({}, {0, 0, 0, 0, -5, -5});
  CHECK(within(box.stress()[4], -5, rounding));
  Cell next = box.cell();
  next.move_inwards(2, -0.1);
  box.move_to(next);
  for (const double work : box.take_loads({}, {0, 0, 0, 0, -5, -5})) CHECK(work == 0);
}

TEST_CASE("walls that return stand where they touch no grain, and bear nothing until they do") {
  Box box(unit_cell, lateral);
  box.take_loads({3, 3, 0, 0, 7, 7}, {});
  const std::vector<Bounds> grains{{{-0.2, 0.1, 0.1}, {0.4, 0.9, 0.9}}, {{0.3, 0.1, 0.1}, {1.1, 0.9, 0.9}}};
  box.move_clear(0, grains);
  box.withdraw(none);
  CHECK(box.has_walls(0));
  CHECK(box.cell().low[0] == -0.2);
  CHECK(box.cell().high[0] == 1.1);
  CHECK(box.cell().length(1) == 1);
  CHECK(box.force()[0] == 0);
  CHECK(box.force()[4] == 7);
}
