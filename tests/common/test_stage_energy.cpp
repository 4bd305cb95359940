// The internal energy of a stage.

#include <catch2/catch.hpp>

#include "common/stage_energy.hpp"

using namespace mpfem;

TEST_CASE("a stage's internal energy is what is stored and what the stage itself has dissipated") {
  // A compaction that dissipates 90 mJ; then a test that stores 4 mJ more and dissipates 1 mJ.
  const auto energy = stage_internal_energy(std::vector<StageEnergyRow>{
      {.stage = 0, .stored = 0, .dissipated = 0},
      {.stage = 0, .stored = 20, .dissipated = 90},
      {.stage = 1, .stored = 20, .dissipated = 90.5}, // begins in the state of the row before
      {.stage = 1, .stored = 24, .dissipated = 91},
  });
  CHECK(energy == std::vector<double>{0, 110, 20.5, 25});
}

TEST_CASE("a branch's internal energy leaves out what was dissipated before it began") {
  const auto energy = stage_internal_energy(std::vector<StageEnergyRow>{
      {.stage = 0, .stored = 2, .dissipated = 90}, // its own first row
      {.stage = 0, .stored = 3, .dissipated = 92},
  });
  CHECK(energy == std::vector<double>{2, 5});
  CHECK(stage_internal_energy({}).empty());
}
