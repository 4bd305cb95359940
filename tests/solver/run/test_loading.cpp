// Loadings: walls that are driven until something happens, walls that are held at a stress, walls that are away.

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// One elastic cube of 0.2 mm that fills its box.
MeshedPacking cube_in_its_box(int cells = 4) {
  GrainMesh cube = cube_mesh(cells);
  scale(cube, 0.1);
  move(cube, {0.1, 0.1, 0.1});
  return pack({cube}, {0.2, 0.2, 0.2});
}

Scenario scenario_of(const std::vector<Stage>& stages, HardeningLaw law = HardeningLaw::power) {
  Scenario scenario = holding_scenario(1e-6, law);
  scenario.walls = true;
  scenario.stages = stages;
  return scenario;
}

Stage loading_stage(const std::string& name, const StageType& loading) {
  Stage stage;
  stage.name = name;
  stage.type = loading;
  return stage;
}

/// A type of loading at a wall speed, its servos three times as fast.
template <class Loading>
Loading loading_at(double speed) {
  Loading loading;
  loading.wall_speed = speed;
  if constexpr (requires { loading.servo_speed; }) loading.servo_speed = 3 * speed;
  return loading;
}

/// Compaction of eight_grains to a mean stress, fast and damped: eight grains vibrate between their walls for long, and
/// what follows is to be measured.
Stage compaction(double mean_stress) {
  auto loading = loading_at<IsotropicLoading>(10000);
  loading.mean_stress = mean_stress;
  Stage stage = loading_stage("compaction", loading);
  stage.damping = {1e6, 1000};
  return stage;
}

Stage unloading(double mean_stress) {
  Stage stage;
  stage.name = "unloading";
  stage.type = IsotropicUnloading{mean_stress, 3000, 0.1};
  stage.damping = {1e6, 1000};
  return stage;
}

/// Walls at rest until the grains are.
Stage rest() {
  Stage stage;
  stage.name = "rest";
  stage.type = Rest{4e-6};
  stage.damping = {1e6, 1000};
  return stage;
}

Stage unconfined(double axial_strain, double speed) {
  auto loading = loading_at<UnconfinedCompression>(speed);
  loading.ends.axial_strain = axial_strain;
  return loading_stage("unconfined", loading);
}

/// A simulation with its scenario and threads.
struct Bench {
  Bench(const MeshedPacking& packing, Scenario s)
      : scenario(std::move(s)), team(2), simulation(build_model(packing, scenario, "test"), scenario, team) {}

  /// Runs the current stage to its end; a row every `every` steps and the last one.
  std::vector<HistoryRow> finish_stage(int every = 20) {
    std::vector<HistoryRow> rows;
    for (int step = 0;; ++step) {
      simulation.evaluate_forces();
      const bool end = simulation.stage_complete();
      if (end || step % every == 0) rows.push_back(simulation.observe());
      if (end) break;
      simulation.advance();
    }
    result = simulation.stage_result();
    return rows;
  }
  void begin_next_stage() {
    simulation.begin_next_stage();
    simulation.advance();
  }
  std::vector<HistoryRow> next_stage(int every = 20) {
    begin_next_stage();
    return finish_stage(every);
  }

  Scenario scenario;
  ThreadTeam team;
  Simulation simulation;
  StageResult result;
};

/// Part by which walls' penalty makes the cube softer along an axis: both walls give way by force / (K A). The areas of
/// nodes at edges and corners are those on all their faces, so that with four cells along an edge their sum A is 1.5
/// times the area of a face.
double wall_compliance(const Simulation& simulation) {
  return 1 + 2 * 5000 / (1.5 * simulation.model().penalty_stiffness[0] * 0.2);
}

} // namespace

TEST_CASE("unconfined compression of an elastic block measures Young's modulus, and walls that are away bear nothing") {
  Bench bench(cube_in_its_box(), scenario_of({unconfined(0.01, 300)}, HardeningLaw::elastic));
  const auto rows = bench.finish_stage();
  const HistoryRow& row = rows.back();
  for (const HistoryRow& r : rows)
    for (std::size_t side = 0; side < 4; ++side) CHECK(r.wall_stress[side] == 0);
  CHECK(row.axial_strain == Approx(0.01).epsilon(1e-6));
  CHECK(row.box_lengths[0] == 0.2); // the cross-section that stress is referred to
  // True stress E eps on an area that grew by 2 nu eps. 2 %: vibration is left, and nodes at edges give way less.
  const double strain = 0.01 / wall_compliance(bench.simulation);
  CHECK(row.wall_stress[4] == Approx(5000 * strain * std::exp(0.6 * strain)).epsilon(0.02));
  CHECK(row.wall_stress[5] == Approx(row.wall_stress[4]).epsilon(0.01));
  CHECK(row.mean_stress == Approx((row.wall_stress[4] + row.wall_stress[5]) / 6).epsilon(1e-12));
  CHECK(std::abs(row.energy_residual) < 0.01 * row.external_work);
  CHECK(bench.result.ended_by == "axial strain 0.01");
}

TEST_CASE("lateral walls hold a constant stress or force within 1 % while an elastic block is compressed") {
  const bool force = GENERATE(false, true);
  auto loading = loading_at<TriaxialCompression>(300);
  loading.hold_force = force;
  loading.lateral_stress = 20;
  loading.ramp_fraction = 0.3;
  loading.ends.axial_strain = 0.03;
  Bench bench(cube_in_its_box(), scenario_of({loading_stage("triaxial", loading)}, HardeningLaw::elastic));
  const auto rows = bench.finish_stage();
  const HistoryRow& row = rows.back();
  CHECK(bench.result.hold_error < 0.01 * 20);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double area = row.box_lengths[1 - axis] * row.box_lengths[2];
    CHECK(row.wall_stress[2 * axis] == Approx(force ? 20 * 0.04 / area : 20.0).epsilon(0.01));
  }
  // Hooke: sigma_z = E eps_z + 2 nu sigma_lateral, 2 %: strains of 3 %, of which the walls take a part.
  const double compliance = wall_compliance(bench.simulation) - 1;
  const double expected = (5000 * 0.03 + 0.6 * row.wall_stress[0]) / (1 + compliance);
  CHECK(row.wall_stress[4] == Approx(expected).epsilon(0.02));
  CHECK(std::abs(row.energy_residual) < 0.01 * row.external_work);
}

TEST_CASE("held walls stay stable on a block in full contact, however stiff the contact and light the block is") {
  // Ten times as stiff as the compact that the walls reckon with, and contact everywhere on them: the hardest case for
  // a servo in steps. What vibrates would pass 0.2 % of the stress within some steps.
  const auto [factor, cells, light] = GENERATE(table<double, int, bool>({{1, 4, false},
                                                                         {10, 4, false},
                                                                         {1000, 4, false},
                                                                         {1000, 2, false},
                                                                         {10, 2, false},
                                                                         {10, 4, true},
                                                                         {100, 4, true}}));
  auto loading = loading_at<TriaxialCompression>(300);
  loading.hold_force = false;
  loading.lateral_stress = 20;
  loading.ramp_fraction = 0.3;
  loading.ends.axial_strain = 0.03;
  Scenario scenario = scenario_of({loading_stage("triaxial", loading)}, HardeningLaw::elastic);
  scenario.contact.stiffness_factor = factor;
  if (light) { // than the steps, which contact sets, need
    scenario.numerics.mass_scaling_step = 1e-9;
    scenario.numerics.mass_scaling_lighten = true;
  }
  Bench bench(cube_in_its_box(cells), scenario);
  const auto rows = bench.finish_stage();
  INFO("penalty " << factor << " E/h, " << cells << " cells along an edge" << (light ? ", light" : ""));
  CHECK(bench.result.hold_error < 0.002 * 20);
  for (std::size_t row = rows.size() / 2; row < rows.size(); ++row)
    for (std::size_t axis = 0; axis < 2; ++axis)
      CHECK(0.5 * (rows[row].wall_stress[2 * axis] + rows[row].wall_stress[2 * axis + 1]) == Approx(20).epsilon(0.01));
  CHECK(rows.back().kinetic_energy < 1e-3 * rows.back().elastic_energy);
}

TEST_CASE("a fixed die presses an elastic block to the stress of uniaxial strain") {
  auto loading = loading_at<DieCompression>(300);
  loading.ends.axial_stress = 100;
  Bench bench(cube_in_its_box(), scenario_of({loading_stage("die", loading)}, HardeningLaw::elastic));
  const HistoryRow row = bench.finish_stage().back();
  CHECK(row.wall_stress[4] == Approx(100).epsilon(0.01));
  // nu/(1 - nu) for stiff walls. The lateral walls give way by a strain of c s_x/E, where c is their compliance:
  // s_x - nu (s_x + s_z) = -c s_x.
  const double compliance = wall_compliance(bench.simulation) - 1;
  CHECK(row.wall_stress[0] / row.wall_stress[4] == Approx(0.3 / (0.7 + compliance)).epsilon(0.02));
  CHECK(row.box_lengths[0] == 0.2);
  CHECK(bench.result.ended_by == "axial stress 100 MPa");
  CHECK(bench.result.overshoot < 1);
}

TEST_CASE("an elastic block that loses a quarter of its volume loses the work that its rate form does not return") {
  auto loading = loading_at<DieCompression>(2000);
  loading.ends.axial_stress = 2200;
  Scenario scenario = scenario_of({loading_stage("die", loading)}, HardeningLaw::elastic);
  scenario.contact.stiffness_factor = 100; // stiff sides, as uniaxial strain requires
  Bench bench(cube_in_its_box(), scenario);
  const HistoryRow row = bench.finish_stage().back();
  const double volume = bench.simulation.model().total_reference_volume();
  const double box = row.box_lengths[0] * row.box_lengths[1] * row.box_lengths[2];
  const double strain = -std::log(row.relative_density_current * box / volume);
  REQUIRE(strain > 0.25);
  // Uniaxial strain x: s:s = (8/3) G^2 x^2 and V = V_0 exp(-x), so that V s:s/(4 G) dx is integrated.
  const double shear = elastic_moduli(scenario.material.youngs_modulus, scenario.material.poissons_ratio).shear;
  const double lost = 2.0 / 3.0 * shear * volume * (2 - std::exp(-strain) * (strain * strain + 2 * strain + 2));
  CHECK(within(row.hypoelastic_dissipation, lost, 0.02)); // the sides give way by a thousandth
  CHECK(row.hypoelastic_dissipation > 0.02 * row.external_work);
  CHECK(std::abs(row.energy_residual) < 1e-4 * row.external_work);
}

TEST_CASE("a soft block on a wider one a hundred times as stiff shortens according to its own modulus") {
  GrainMesh soft = cube_mesh(4), stiff = cube_mesh(4);
  scale(soft, 0.1), scale(stiff, 0.15);
  move(soft, {0.15, 0.15, 0.1}), move(stiff, {0.15, 0.15, 0.35});
  Stage stage = unconfined(0.002, 50);
  stage.damping = {1e6, 1e4}; // the stiff one rings on the soft one
  Scenario scenario = scenario_of({stage}, HardeningLaw::elastic);
  MaterialParameters other = scenario.material;
  other.youngs_modulus *= 100;
  scenario.grain_materials = {{{1}, other}};
  Bench bench(pack({soft, stiff}, {0.3, 0.3, 0.5}), scenario);
  const auto rows = bench.finish_stage();
  const Model& model = bench.simulation.model();
  const double k = model.penalty_stiffness[0], other_k = model.penalty_stiffness[1];
  CHECK(within(other_k * model.element_size[1], 100 * k * model.element_size[0], rounding));
  // One behind the other: the soft block, the wall's penalty and the contact's; the stiff one adds a hundredth of that.
  const double compliance = 0.2 / 5000 + 1 / k + (k + other_k) / (2 * k * other_k) + 0.3 / 500000 * 0.04 / 0.09;
  const double force = 0.5 * (1 - std::exp(-0.002)) / compliance * 0.04;
  CHECK(rows.back().wall_stress[4] * 0.09 == Approx(force).epsilon(0.02)); // its section grows by 0.3 %; nodal areas
  CHECK(rows.back().wall_stress[5] == Approx(rows.back().wall_stress[4]).epsilon(0.02));
  for (const HistoryRow& row : rows) CHECK(std::abs(row.energy_residual) < 0.01 * rows.back().external_work);
}

TEST_CASE("a packing is compacted to a mean stress and cycles between two, meeting each within 2 % of the range") {
  auto loading = loading_at<StressCycles>(3000);
  loading.lowest_mean_stress = 1;
  loading.highest_mean_stress = 20;
  loading.cycles = 2;
  Bench bench(eight_grains(4), scenario_of({compaction(20), loading_stage("cycles", loading)}));
  const HistoryRow loaded = bench.finish_stage().back();
  CHECK(loaded.mean_stress == Approx(20).epsilon(0.02));
  const auto rows = bench.next_stage(1);
  double highest = 0, lowest = 100;
  int turns = 0;
  bool up = true; // it begins at the upper stress
  for (const HistoryRow& row : rows) {
    if (turns >= 2) highest = std::max(highest, row.mean_stress);
    lowest = std::min(lowest, row.mean_stress);
    if (up ? row.mean_stress >= 20 : row.mean_stress <= 1.01) {
      up = !up;
      ++turns;
    }
  }
  CHECK(turns == 4);
  CHECK(highest < 20 + 0.02 * 19);
  CHECK(lowest > 1 - 0.02 * 19);
  CHECK(rows.back().mean_stress == Approx(1).margin(0.02 * 19));
  CHECK(bench.result.ended_by == "2 cycles");
  CHECK(bench.result.overshoot == Approx(std::max(highest - 20, 1 - lowest)).margin(0.01));
  CHECK(std::abs(rows.back().energy_residual) < 0.01 * rows.back().external_work);
}

TEST_CASE("lateral walls hold the force that acts within 1 % while a packing is compressed, sheared and dilates") {
  auto loading = loading_at<TriaxialCompression>(1000);
  loading.ends.axial_strain = 0.05;
  Bench bench(eight_grains(4), scenario_of({compaction(30), unloading(15), loading_stage("triaxial", loading)}));
  bench.finish_stage();
  bench.next_stage();
  const auto rows = bench.next_stage();
  CHECK(bench.result.hold_error < 0.01 * bench.result.hold_stress);
  CHECK(rows.back().deviatoric_stress > 10);
  const auto force = [](const HistoryRow& row) {
    return 0.5 * (row.wall_stress[0] + row.wall_stress[1]) * row.box_lengths[1] * row.box_lengths[2];
  };
  CHECK(force(rows.back()) == Approx(force(rows.front())).epsilon(0.02)); // two moments, with their vibration
  CHECK(std::abs(rows.back().energy_residual) < 0.01 * rows.back().external_work);
  CHECK(rows.back().kinetic_energy < 0.01 * (rows.back().elastic_energy + rows.back().plastic_dissipation));
}

TEST_CASE("a packing is held at a mean stress within 1 %, and is brought to it from above or below") {
  const double stress = GENERATE(8.0, 25.0);
  const HeldStress loading{.mean_stress = stress, .duration = 4e-6, .servo_speed = 6000};
  Stage held = loading_stage("held", loading);
  held.damping = {2e6, 1e4};
  Bench bench(eight_grains(4), scenario_of({compaction(30), unloading(15), held}));
  bench.finish_stage();
  bench.next_stage();
  const auto rows = bench.next_stage();
  CHECK(bench.result.hold_error < 0.01 * stress);
  CHECK(bench.result.ended_by == "duration 4e-06 s");
  int late = 0;
  for (const HistoryRow& row : rows) {
    if (row.time < rows.front().time + 2e-6) continue;
    ++late;
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK(0.5 * (row.wall_stress[2 * axis] + row.wall_stress[2 * axis + 1]) == Approx(stress).epsilon(0.01));
  }
  CHECK(late > 3);
  CHECK(rows.back().kinetic_energy < 1e-3 * rows.back().elastic_energy);
}

TEST_CASE("a probe stays within 1 % of its line of p and q, in compression and in extension, until it dissipates") {
  const double dq = GENERATE(1.5, -1.0);
  auto loading = loading_at<StressProbe>(500);
  loading.direction = {1, dq};
  loading.ends.dissipation_ratio = 1.01;
  Bench bench(eight_grains(4), scenario_of({compaction(30), unloading(20), rest(), loading_stage("probe", loading)}));
  bench.finish_stage();
  bench.next_stage();
  const HistoryRow start = bench.next_stage().back();
  const auto rows = bench.next_stage();
  const HistoryRow& end = rows.back();
  CHECK(end.plastic_dissipation >= 1.01 * start.plastic_dissipation);
  CHECK(end.plastic_dissipation < 1.012 * start.plastic_dissipation);
  CHECK(end.mean_stress > start.mean_stress + 5);
  CHECK(bench.result.hold_error < 0.01 * bench.result.hold_stress);
  const HistoryRow& first = rows.front();
  for (const HistoryRow& row : rows)
    CHECK(std::abs(row.deviatoric_stress - first.deviatoric_stress - dq * (row.mean_stress - first.mean_stress)) <
          0.01 * end.mean_stress);
}

TEST_CASE("unconfined compression ends when the axial stress has fallen from its peak") {
  Stage stage = unconfined(0.3, 2000);
  auto& loading = std::get<UnconfinedCompression>(stage.type);
  loading.ends.stress_drop = 0.3;
  loading.ramp_fraction = 0.02;
  Scenario scenario = scenario_of({compaction(30), unloading(1), stage});
  scenario.bond = BondParameters{25, 18, 0.05};
  Bench bench(eight_grains(4), scenario);
  bench.finish_stage();
  bench.next_stage();
  const auto rows = bench.next_stage();
  double peak = 0;
  for (const HistoryRow& row : rows) peak = std::max(peak, 0.5 * (row.wall_stress[4] + row.wall_stress[5]));
  const double last = 0.5 * (rows.back().wall_stress[4] + rows.back().wall_stress[5]);
  CHECK_THAT(bench.result.ended_by, Catch::Contains("stress drop"));
  CHECK(last < 0.8 * peak);
  CHECK(last > 0.3 * peak); // it goes on falling while the average over a transit falls
}

TEST_CASE("the ledger closes when lateral walls are taken away, and when they return") {
  auto again = loading_at<TriaxialCompression>(1000);
  again.lateral_stress = 5;
  again.ends.duration = 1e-5;
  Scenario scenario = scenario_of({compaction(20), unconfined(0.01, 500), loading_stage("again", again)});
  scenario.bond = BondParameters{25, 18, 0.5};
  Bench bench(eight_grains(4), scenario);
  const HistoryRow loaded = bench.finish_stage().back();
  REQUIRE(loaded.wall_stress[0] > 10); // walls leave while they are pressed
  const HistoryRow freed = bench.next_stage().back();
  CHECK(std::abs(freed.energy_residual - loaded.energy_residual) < 0.002 * loaded.external_work);
  bench.simulation.begin_next_stage();
  // Grains have moved out; the walls return where they touch nothing.
  const Model& model = bench.simulation.model();
  const Cell& cell = bench.simulation.box().cell();
  CHECK(cell.length(0) > freed.box_lengths[0]);
  bool outside = false;
  for (std::size_t n = 0; n < model.position.size(); n += 4)
    for (std::size_t axis = 0; axis < 2; ++axis)
      outside = outside || model.position[n + axis] < cell.low[axis] || model.position[n + axis] > cell.high[axis];
  CHECK_FALSE(outside);
  bench.simulation.advance();
  const HistoryRow held = bench.finish_stage().back();
  CHECK(held.wall_stress[0] > 1);
  CHECK(std::abs(held.energy_residual) < 0.01 * held.external_work);
}

TEST_CASE("a loading that cannot reach its end is a failed simulation") {
  SECTION("walls that would have to pull") {
    auto loading = loading_at<StressProbe>(3000);
    loading.direction = {-1, 0};
    loading.ends.dissipation_ratio = 100;
    Bench bench(eight_grains(3), scenario_of({compaction(10), loading_stage("probe", loading)}));
    bench.finish_stage();
    CHECK_THROWS_WITH(bench.next_stage(), Catch::Contains("'probe'") && Catch::Contains("pull"));
  }
  SECTION("a peak that does not come") {
    auto loading = loading_at<DieCompression>(3000);
    loading.ends.axial_stress = 1e6;
    Bench bench(cube_in_its_box(), scenario_of({loading_stage("die", loading)}, HardeningLaw::elastic));
    CHECK_THROWS_WITH(bench.finish_stage(), Catch::Contains("'die'") && Catch::Contains("not reached"));
  }
  SECTION("a compaction to less than what acts") {
    auto loading = loading_at<IsotropicLoading>(3000);
    loading.mean_stress = 5;
    Bench bench(eight_grains(3), scenario_of({compaction(10), loading_stage("again", loading)}));
    bench.finish_stage();
    CHECK_THROWS_WITH(bench.next_stage(), Catch::Contains("'again'") && Catch::Contains("mean_stress"));
  }
  SECTION("a dissipation to be compared with nothing") {
    auto loading = loading_at<DieCompression>(300);
    loading.ends.dissipation_ratio = 1.1;
    Bench bench(cube_in_its_box(), scenario_of({loading_stage("die", loading)}, HardeningLaw::elastic));
    CHECK_THROWS_WITH(bench.finish_stage(), Catch::Contains("dissipation_ratio"));
  }
}
