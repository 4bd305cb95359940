// When the stable step is estimated again, and for which grains.

#include <catch2/catch.hpp>

#include <algorithm>

#include "common/index.hpp"
#include "solver/kernels/surface.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// s, the stable step of the state as it is, every grain's frequency computed.
double step_computed_afresh(const Simulation& simulation, const Scenario& scenario, ThreadTeam& team) {
  Model model = simulation.model();
  std::vector<Bounds> bounds;
  for (const std::int32_t grain : model.own()) bounds.push_back(surface_bounds(model, grain));
  StepEstimate estimate(model, scenario.numerics, simulation.ranks());
  estimate.restore(simulation.step_estimate().state());
  estimate.renew(model, simulation.contact(), {simulation.box(), simulation.tools()}, bounds, team, true);
  return estimate.stable_step();
}

} // namespace

// Frequencies are known to 2 % in their squares, they are bounds between computations, and between estimates strains of
// 2 % change them by 4 %; what contact adds since the last estimate of all grains is covered by time_step_factor.
TEST_CASE("the step stays near that of an estimate of all grains, though only those that have strained are estimated") {
  const Scenario scenario = compaction_scenario(0.8, 4000);
  ThreadTeam team(2);
  Simulation simulation(build_model(eight_grains(4), scenario, "test"), scenario, team);
  int compared = 0, partial = 0;
  while (!simulation.stage_complete()) {
    simulation.evaluate_forces();
    const double before = simulation.step_estimate().stable_step();
    simulation.advance();
    const bool renewed = simulation.step_estimate().stable_step() != before;
    if (renewed && simulation.step_estimate().state().steps_since_estimate > 0) ++partial;
    if (simulation.state().step % 23 != 0) continue;
    const double wanted = step_computed_afresh(simulation, scenario, team);
    CAPTURE(simulation.state().step, simulation.relative_density());
    CHECK(simulation.step_estimate().stable_step() < 1.06 * wanted);
    CHECK(simulation.step_estimate().stable_step() > 0.9 * wanted);
    ++compared;
  }
  CHECK(compared > 20);
  CHECK(partial > 0);
}

TEST_CASE("a grain at rest is estimated with all others, not each time another grain has strained") {
  Scenario scenario = holding_scenario(1e-6, HardeningLaw::elastic);
  GrainMesh still = ball_mesh(4, 0.1), stretched = still;
  move(still, {0.3, 0.3, 0.3});
  move(stretched, {0.7, 0.7, 0.7});
  ThreadTeam team(1);
  Simulation simulation(build_model(pack({still, stretched}, {1, 1, 1}), scenario, "test"), scenario, team);
  Model& model = simulation.model_to_disturb();
  const double rate = 0.003 / simulation.step_estimate().stable_step(); // 0.3 % in a step
  for (std::size_t n = at(model.node_offset[1]); n < at(model.node_offset[2]); ++n)
    model.velocity[4 * n] = rate * (model.position[4 * n] - 0.7);
  int estimates = 0;
  for (int step = 1; step < 30; ++step) {
    simulation.evaluate_forces();
    const double before = simulation.step_estimate().grain_steps().strain[1];
    simulation.advance();
    if (simulation.step_estimate().grain_steps().strain[1] < before) ++estimates;
    CHECK(simulation.step_estimate().grain_steps().strain[1] <= 0.02);
    CHECK(simulation.step_estimate().grain_steps().estimates[0] == 0);
  }
  CHECK(estimates >= 3);
}
