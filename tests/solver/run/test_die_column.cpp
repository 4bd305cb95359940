// A cylinder in a rigid die: the force that ejects it, and the cycle of a plastic one that is pressed and released.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/die_column.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

struct Ejected {
  double wall_stress = 0; ///< MPa, of the column at rest, a mean over its wall
  double friction = 0;    ///< N, of the die on the quarter that is pushed up
  double force = 0;       ///< N, of the lower punch that pushes it
};

/// Puts a column that is too wide by a thousandth of its radius into the die, and pushes it up if `push`. The column is
/// at rest after twelve transits; forces are means of the last sixteen.
Ejected eject(int n, double nu, double mu, bool push) {
  using namespace die_column;
  const Settings settings{.n = n};
  Scenario scenario = scene(settings, nu, mu);
  const double way = 4e-3, duration = 40 * transit; // mm, s: four times of what the column gives under the force
  const ToolDrive punch{.tool = lower, .velocity = {0, 0, way / duration}, .direction = {0, 0, 1}};
  scenario.stages = {driven({}, 20 * transit, 1 / transit)};
  if (push) scenario.stages.push_back(driven({punch}, duration, 0.05 / transit));
  for (Stage& stage : scenario.stages) {
    auto& loading = std::get<ToolLoading>(stage.type);
    loading.away = {upper};
    loading.ramp_fraction = 0.01; // five transits
  }
  ThreadTeam team(1);
  // A run would refuse a column inside its die, a branch takes what it has.
  Simulation simulation(build_model(column(settings, 1e-3), scenario, "test"), scenario, team, true);
  simulation.begin_branch({});
  Ejected ejected;
  double levels = 0;
  const auto run_stage = [&](double time, auto&& look) {
    for (levels = 0, simulation.evaluate_forces(); !simulation.stage_complete(); simulation.evaluate_forces()) {
      if (simulation.state().time > time) look(), levels += 1;
      simulation.advance();
    }
  };
  run_stage(12 * transit, [&] { ejected.wall_stress += simulation.tools().load(die).normal_force; });
  ejected.wall_stress = wall_stress(n, ejected.wall_stress / levels, column_height);
  if (!push) return ejected;
  simulation.begin_next_stage();
  run_stage(44 * transit, [&] {
    ejected.friction += simulation.tools()[die].force[2], ejected.force -= simulation.tools()[lower].force[2];
  });
  ejected.friction /= levels, ejected.force /= levels;
  return ejected;
}

} // namespace

// Pushing widens the column: with sigma_r = sigma_res + K sigma_z, K = nu/(1 - nu), Janssen's balance gives the force
// (section sigma_res/K) (exp(x) - 1), x = 4 mu K H/D. It leaves out that sections warp: by axisymmetric finite elements
// 0.2 % (x = 0.17) and 2.2 % (x = 0.51) more is needed. Measured: -1.1 and +0.6 % at the die, -0.1 and +0.8 % at the
// punch.
TEST_CASE("a column that a die holds by its residual stress is ejected by the force of the closed form") {
  constexpr double nu = 0.3, k = nu / (1 - nu);
  constexpr int n = 8;
  const double rest = eject(n, nu, 0, false).wall_stress;
  CAPTURE(rest);
  // A disc that is pressed all around, whose wall gives by 1 % of that; with a penalty of 100 E/h it is 0.5 % below.
  CHECK(within(rest, 1e-3 * 5000 / (1 - nu), 0.02));
  for (const double mu : {0.1, 0.3}) {
    const double x = 4 * mu * k * die_column::column_height / (2 * die_column::column_radius);
    const double law = die_column::section(n) * rest / k * (std::exp(x) - 1);
    const Ejected ejected = eject(n, nu, mu, true);
    CAPTURE(mu, ejected.friction / law, ejected.force / law);
    CHECK(within(ejected.friction, law, 0.02));
    CHECK(within(ejected.force, law, 0.02));
  }
}

namespace {

constexpr double yield_stress = 10, cycle_nu = 0.3;                                // MPa, 1
constexpr double first_yield = yield_stress * (1 - cycle_nu) / (1 - 2 * cycle_nu); // MPa, of the axial stress

/// Stresses of punch and wall, MPa.
struct Stresses {
  double axial, radial;
};

/// Long's cycle (1960) of a body that yields at a constant stress: radial stress where the axial one has risen to
/// `axial`, and where it has fallen from `top` to it.
double radial_when_pressed(double axial) {
  const double elastic = cycle_nu / (1 - cycle_nu) * axial;
  return std::max(elastic, axial - yield_stress);
}
double radial_when_released(double axial, double top) {
  const double elastic = radial_when_pressed(top) - cycle_nu / (1 - cycle_nu) * (top - axial);
  return std::min(elastic, axial + yield_stress);
}

/// Presses a smooth column to an axial stress (MPa) and releases it. Each entry is the mean of one transit of waves.
struct Cycle {
  std::vector<Stresses> pressed, released;
  double top = 0; ///< MPa, axial stress at rest in between
};
Cycle press_and_release(const die_column::Settings& settings, double top) {
  using namespace die_column;
  Scenario scenario = scene(settings, cycle_nu, 0);
  scenario.material.hardening = {HardeningLaw::power, yield_stress, 0, 1, {}, {}};
  // Lateral strains are 0: the stress rises by E (1 - nu)/((1 + nu) (1 - 2 nu)), where it yields by E/(3 (1 - 2 nu)).
  const double elastic = std::min(top, first_yield), bulk = 5000 / (3 * (1 - 2 * cycle_nu));
  const double strain = elastic / (3 * bulk * (1 - cycle_nu) / (1 + cycle_nu)) + (top - elastic) / bulk;
  const auto drive = [&](double sign) {
    const double speed = sign * 1e-4 * column_height / transit;
    Stage stage = driven({{.tool = upper, .velocity = {0, 0, speed}, .direction = {0, 0, -1}}}, 1, 0.02 / transit);
    auto& loading = std::get<ToolLoading>(stage.type);
    loading.ends.travel = column_height * (1 - std::exp(-strain));
    loading.ramp_fraction = 0.2;
    return stage;
  };
  scenario.stages = {drive(-1), driven({}, 10 * transit, 0.5 / transit), drive(1)};
  ThreadTeam team(1);
  Simulation simulation(build_model(column(settings), scenario, "test"), scenario, team);
  const auto mean_of_transit = [&] {
    Stresses mean{0, 0};
    double levels = 0;
    for (const double end = simulation.state().time + transit; simulation.state().time < end; levels += 1) {
      simulation.evaluate_forces();
      const double height = column_height + simulation.tools()[upper].moved[2];
      mean.axial +=
          0.5 * (simulation.tools()[upper].force[2] - simulation.tools()[lower].force[2]) / section(settings.n);
      mean.radial += wall_stress(settings.n, simulation.tools().load(die).normal_force, height);
      simulation.advance();
    }
    return Stresses{mean.axial / levels, mean.radial / levels};
  };
  Cycle cycle;
  do cycle.pressed.push_back(mean_of_transit());
  while (!simulation.stage_complete());
  simulation.begin_next_stage();
  for (int i = 0; i < 10; ++i) cycle.top = mean_of_transit().axial;
  simulation.begin_next_stage();
  do cycle.released.push_back(mean_of_transit());
  while (cycle.released.back().axial > 0.1 * yield_stress);
  return cycle;
}

} // namespace

// The wall gives by 0.1 % of the elastic radial stress; 0.12 to 0.2 % of the largest were measured.
TEST_CASE("a smooth die holds a pressed plastic column as in Long's cycle: elastic, yielding, released") {
  // Below the first yielding at Y (1 - nu)/(1 - 2 nu) nothing stays; beyond, up to Y.
  for (const double wanted : {0.8, 1.5, 2.5}) {
    const Cycle cycle = press_and_release({.n = 4, .penalty = 400}, wanted * first_yield);
    const double top = cycle.top;
    double loading = 0, unloading = 0;
    for (const Stresses& at : cycle.pressed)
      loading = std::max(loading, std::abs(at.radial - radial_when_pressed(at.axial)));
    for (const Stresses& at : cycle.released)
      unloading = std::max(unloading, std::abs(at.radial - radial_when_released(at.axial, top)));
    const Stresses last = cycle.released.back();
    const double residual = radial_when_released(last.axial, top);
    CAPTURE(wanted, top, loading, unloading, last.radial, residual, cycle.pressed.size(), cycle.released.size());
    const double largest = radial_when_pressed(top);
    CHECK(loading < 0.005 * largest);
    CHECK(unloading < 0.005 * largest);
    CHECK(std::abs(last.radial - residual) < 0.005 * largest);
  }
}
