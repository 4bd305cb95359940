// Stages that choose their speed by tolerances of quasi-static loading.

#include <catch2/catch.hpp>

#include "solver/run/loading_rate.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double transit = 1e-6; // s

QuasiStatic tolerances() {
  return {.kinetic_tolerance = 0.01,
          .stress_tolerance = 0.02,
          .slowest_speed = 100,
          .fastest_speed = 4000,
          .loose_stress = 0.5};
}

/// A packing whose kinetic energy is `kinetic` times its internal energy at its own speed, and which bears 10 MPa.
LoadingRateObservation seen(double factor, double kinetic) {
  LoadingRateObservation seen;
  seen.elapsed = 0.05 * transit;
  seen.kinetic_energy = kinetic * factor * factor;
  seen.elastic_energy = 0.25;
  seen.plastic_dissipation = 0.75;
  seen.wall_stress.fill(10);
  return seen;
}

/// The compaction of eight grains, to a density at which they bear load.
struct Compaction {
  std::vector<HistoryRow> rows;
  LoadingRateState rate;
};
Compaction compact(std::optional<QuasiStatic> quasi_static, double wall_speed) {
  Scenario scenario = compaction_scenario(0.75, wall_speed);
  scenario.stages.front().quasi_static = quasi_static;
  ThreadTeam team(2);
  Simulation simulation(build_model(eight_grains(3), scenario, "test"), scenario, team);
  Compaction result;
  for (std::int64_t step = 0;; ++step) {
    simulation.evaluate_forces();
    const bool end = simulation.stage_complete();
    if (end || step % 25 == 0) result.rows.push_back(simulation.observe());
    if (end) break;
    simulation.advance();
  }
  result.rate = simulation.stage_run().loading_rate();
  return result;
}

} // namespace

TEST_CASE(
    "the loading rate settles where kinetic energy is within its tolerance, whether it began too fast or too slow") {
  const LoadingRateControl control(tolerances(), 1000, transit);
  for (const double kinetic : {0.0025, 0.09}) {
    LoadingRateState state;
    for (int i = 0; i < 1000; ++i) control.update(state, seen(state.factor, kinetic));
    CHECK(kinetic * state.factor * state.factor < 0.01);
    CHECK(kinetic * state.factor * state.factor > 0.004); // and no slower than it has to be
  }
}

TEST_CASE(
    "the loading rate settles where inertia carries no more of the stress than allowed, between walls or within") {
  const LoadingRateControl control(tolerances(), 1000, transit);
  for (const auto borne : {&LoadingRateObservation::imbalance, &LoadingRateObservation::dynamic}) {
    LoadingRateState state;
    for (int i = 0; i < 1000; ++i) {
      LoadingRateObservation now = seen(state.factor, 1e-6);
      (now.*borne)[1] = -0.5 * state.factor; // 5 % of the walls' stress
      control.update(state, now);
    }
    CHECK(state.factor * 0.05 < 0.02);
    CHECK(state.factor * 0.05 > 0.01);
    CHECK(state.largest_stress > 0.02); // at the beginning
  }
}

TEST_CASE("walls that are about to stop are not accelerated") {
  const LoadingRateControl control(tolerances(), 1000, transit);
  LoadingRateState state{.factor = 3};
  for (int look = 0; look < 40; ++look) {
    LoadingRateObservation now = seen(state.factor, 1e-9);
    now.stopping = true;
    control.update(state, now);
  }
  CHECK(state.factor == 1);
}

TEST_CASE("walls that are about to stop are slowed down where nothing presses on them any more") {
  const LoadingRateControl control(tolerances(), 1000, transit);
  LoadingRateState state{.factor = 3};
  for (int look = 0; look < 40; ++look) {
    LoadingRateObservation now = seen(state.factor, 1e-9);
    now.wall_stress.fill(0.1);
    now.stopping = true;
    control.update(state, now);
  }
  CHECK(state.factor == 1);
}

TEST_CASE("grips that pull bear load as walls that press do") {
  const LoadingRateControl control(tolerances(), 1000, transit);
  LoadingRateState state;
  for (int i = 0; i < 1000; ++i) {
    LoadingRateObservation now = seen(state.factor, 0.09);
    now.wall_stress = {0, 0, -10};
    control.update(state, now);
  }
  CHECK(state.factor < 0.4);
  CHECK(state.time_loaded > 0);
}

TEST_CASE("the loading rate keeps to its bounds, and says when the slowest is not slow enough") {
  const LoadingRateControl control(tolerances(), 1000, transit);
  LoadingRateState hot, calm;
  for (int i = 0; i < 1000; ++i) {
    control.update(hot, seen(1, 10.0));
    control.update(calm, seen(1, 1e-9));
  }
  CHECK(within(hot.factor, 0.1, accumulated_rounding));
  CHECK(hot.at_slowest == 1);
  CHECK(within(hot.time_beyond, hot.time_loaded, accumulated_rounding));
  CHECK(within(calm.factor, 4, accumulated_rounding));
  CHECK(calm.at_slowest == 0);
  CHECK(calm.time_beyond == 0);
}

TEST_CASE("a loose packing is distinguished from one whose dissipation belongs to another stage") {
  const LoadingRateControl control(tolerances(), 1000, transit);
  LoadingRateState loose;
  LoadingRateObservation flight = seen(1, 10.0);
  flight.wall_stress.fill(0.4);
  for (int look = 0; look < 100; ++look) control.update(loose, flight);
  CHECK(loose.factor == 1);
  // What was dissipated before the stage does not count as internal energy: 0.0039 over 0.25 is beyond 1 %.
  LoadingRateState later{.dissipation_at_start = 0.75};
  control.update(later, seen(1, 0.0039));
  CHECK(within(later.largest_kinetic, 0.0039 / 0.25, accumulated_rounding));
  CHECK(later.factor < 1);
}

TEST_CASE(
    "a compaction that chooses its speed meets its target, slows down while it jams and accelerates where it may") {
  QuasiStatic q{.kinetic_tolerance = 0.02,
                .stress_tolerance = 0.1, // eight grains: each is a quarter of a wall
                .slowest_speed = 1000,
                .fastest_speed = 20000,
                .loose_stress = 0.5};
  const Compaction chosen = compact(q, 5000), fast = compact({}, q.fastest_speed);
  CHECK(chosen.rows.back().relative_density == Approx(0.75).epsilon(1e-9));
  CHECK(chosen.rate.slowest < 1);
  CHECK(chosen.rate.fastest > 1);
  CHECK(chosen.rate.time_loaded > 0);
  CHECK(fast.rate.factor == 1);
  CHECK(std::abs(chosen.rows.back().energy_residual) < 0.01 * chosen.rows.back().external_work);
  // Under load it keeps within the tolerance, which its largest speed all the way does not.
  const auto largest_ratio = [](const Compaction& c) {
    double largest = 0;
    for (const HistoryRow& row : c.rows)
      if (row.relative_density > 0.66)
        largest = std::max(largest, row.kinetic_energy / (row.elastic_energy + row.plastic_dissipation));
    return largest;
  };
  CHECK(largest_ratio(chosen) < q.kinetic_tolerance);
  CHECK(largest_ratio(fast) > q.kinetic_tolerance);
}
