#include "solver/bench/bench.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/index.hpp"
#include "solver/bench/dense_packing.hpp"
#include "solver/bench/machine.hpp"
#include "solver/bench/result.hpp"
#include "solver/bench/work.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/model/smooth_surface.hpp"
#include "solver/model/tets.hpp"
#include "solver/run/resume.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/stage_forecast.hpp"

namespace mpfem {

namespace {

constexpr double strain_per_step = 5e-5;        // linear, of the built-in packing: some four times that of a usual run
constexpr int warm_up_steps = 300;              // 1.5 % in length: contacts closed, grains flowing
constexpr double initial_plastic_strain = 0.02; // of the built-in packing, from which it hardens further

/// Table 1 of Ku, Zhao, Mollon and Zhao; density of solid microcrystalline cellulose.
Scenario built_in_scenario(const BenchOptions& options) {
  Scenario scenario;
  scenario.packing_file = "built-in packing";
  scenario.material.density = 1.55e-9;
  scenario.material.youngs_modulus = 5000;
  scenario.material.poissons_ratio = 0.3;
  scenario.material.hardening = {HardeningLaw::power, 25, 125, 0.3, {}, {}};
  if (options.bonds) {
    scenario.bond.emplace();
    scenario.bond->tensile_strength = 25;
    scenario.bond->shear_strength = 18;
    scenario.bond->fracture_energy = 0.5;
  }
  scenario.contact.friction = scenario.wall_friction = options.friction;
  scenario.numerics.element = options.element;
  scenario.numerics.own_pressure = usual_own_pressure(options.element);
  scenario.numerics.precision = options.precision;
  Stage stage;
  stage.name = "compaction";
  stage.type = IsotropicCompaction{};
  scenario.stages.push_back(stage);
  return scenario;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// Gives the grains the hardening of an initial plastic strain, as in a compact.
void set_initial_hardening(Model& model) {
  const auto* law = std::get_if<PowerLaw>(&model.material_of(0).flow);
  const double flow_stress = law->yield_stress + law->coefficient * std::pow(initial_plastic_strain, law->exponent);
  std::visit(
      [&](auto& blocks) {
        for (auto& block : blocks) {
          std::fill(std::begin(block.plastic_strain), std::end(block.plastic_strain), initial_plastic_strain);
          std::fill(std::begin(block.flow_stress), std::end(block.flow_stress), flow_stress);
        }
      },
      model.blocks);
}

/// Calls f(position, velocity) for all nodes of the rank's own grains.
template <class F>
void for_own_nodes(Model& model, F&& f) {
  for (const std::int32_t grain : model.own())
    for (std::size_t row = model.first_row(grain); row < model.end_row(grain); row += 4)
      f(&model.position[row], &model.velocity[row]);
}

/// Walls and grains move inwards by one affine motion from the start.
void approach_affinely(Simulation& simulation, Scenario& scenario) {
  Model& model = simulation.model_to_disturb();
  const double rate = strain_per_step / simulation.step_estimate().stable_step();
  std::get<IsotropicCompaction>(scenario.stages[0].type).wall_speed =
      0.5 * rate * *std::max_element(model.box_high.begin(), model.box_high.end());
  simulation.begin_stage(0);
  for_own_nodes(model, [&](const double* x, double* v) {
    for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = -rate * (x[axis] - 0.5 * model.box_high[axis]);
  });
}

/// The median of three segments of the steps.
StepCost measure_steps(Simulation& simulation, int steps) {
  const double tets = simulation.model().tets();
  std::array<StepCost, 3> segments;
  for (StepCost& segment : segments) {
    const Profile before = simulation.profile();
    const auto start = Profile::Clock::now();
    int taken = 0;
    for (; taken < (steps + 2) / 3 && !simulation.stage_complete(); ++taken) {
      simulation.evaluate_forces();
      simulation.advance();
    }
    if (taken == 0)
      throw InputError("mpfem bench: the stage ends before all steps are measured, allowed: fewer --steps");
    const double scale = 1e9 / (taken * tets);
    segment.whole = scale * Profile::since(start);
    for (std::size_t p = 0; p < profile_parts; ++p)
      segment.part[p] =
          scale * (simulation.profile().seconds(static_cast<Part>(p)) - before.seconds(static_cast<Part>(p)));
  }
  std::sort(segments.begin(), segments.end(), [](const StepCost& x, const StepCost& y) { return x.whole < y.whole; });
  return segments[1];
}

/// What this rank has spent and sent since the beginning.
struct RankTotals {
  explicit RankTotals(const Simulation& simulation)
      : steps(simulation.state().step), sent(simulation.ghosts().bytes_sent()), messages(simulation.ghosts().waited()),
        sums(simulation.ranks().seconds_in_sums()) {
    for (const Part part : {Part::elements, Part::contact, Part::integration, Part::surface})
      busy += simulation.profile().seconds(part);
  }
  std::int64_t steps, sent;
  double messages, sums; ///< s waited for messages and in sums
  double busy = 0;       ///< s of work
};

template <class Body>
double median_time(int repetitions, const Body& body) {
  std::vector<double> seconds;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = Profile::Clock::now();
    body();
    seconds.push_back(Profile::since(start));
  }
  return median(seconds);
}

/// Collective. The sum over the ranks of a number, rounded to an integer on each.
double total(double own, const Communicator& ranks) {
  std::array<std::int64_t, 1> sum{std::llround(own)};
  ranks.combine(sum, {});
  return static_cast<double>(sum[0]);
}

/// Collective. The mean of the ranks' numbers, to 1e-9.
double mean(double own, const Communicator& ranks) {
  return 1e-9 * total(1e9 * own, ranks) / ranks.size();
}

/// Collective. What the ranks have cost each other since `before`.
RankCost cost_of_ranks(const Simulation& simulation, const RankTotals& before) {
  const Communicator& ranks = simulation.ranks();
  const RankTotals now(simulation);
  const auto steps = static_cast<double>(now.steps - before.steps);
  const double per_tet_step = 1e9 / (steps * simulation.model().tets());
  const double sums = per_tet_step * (now.sums - before.sums), busy = now.busy - before.busy;
  return {.sent = ranks.largest(static_cast<double>(now.sent - before.sent)) / steps,
          .waited_for_messages = mean(per_tet_step * (now.messages - before.messages), ranks),
          .waited_in_sums = mean(sums, ranks),
          .waited_in_sums_least = -ranks.largest(-sums),
          .imbalance = ranks.largest(busy) / mean(busy, ranks)};
}

/// Gives all own nodes the velocities of a shear at the rate of the warm-up (isochoric stretching along x).
void shear(Model& model, double step) {
  const double rate = strain_per_step / step;
  for_own_nodes(model, [&](const double* x, double* v) {
    v[0] = rate * x[0], v[1] = -0.5 * rate * x[1], v[2] = -0.5 * rate * x[2];
  });
}

/// Plastic strains of all own tets.
std::vector<double> plastic_strains(const Model& model) {
  std::vector<double> all;
  for_each_tet(model, [&](const auto& block, int lane, std::size_t) { all.push_back(block.plastic_strain[lane]); });
  return all;
}

/// Collective. The time is that of the slowest rank while all compute.
ElementCost measure_elements(Model& model, double step, ThreadTeam& team, const Communicator& ranks) {
  shear(model, step);
  const std::vector<std::int32_t>& own = model.own();
  const auto pass = [&] {
    team.for_each(static_cast<int>(own.size()), [&](int i, int) { element_forces(model, own[at(i)], step); });
  };
  for (int i = 0; i < 200; ++i) pass();
  ElementCost cost;
  cost.nanoseconds = 1e9 * ranks.largest(median_time(31, pass)) / model.tets();
  const std::vector<double> before = plastic_strains(model);
  pass();
  const std::vector<double> after = plastic_strains(model);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) moved += after[i] > before[i] ? 1U : 0U;
  cost.hardening = total(static_cast<double>(moved), ranks) / model.tets();
  return cost;
}

/// Collective. What all ranks do at the same time.
MachineLimits measure_machine(ThreadTeam& team, const Communicator& ranks) {
  ranks.largest(0); // begin together
  const double triad = measure_triad(team);
  ranks.largest(0);
  return {1e-9 * total(1e9 * triad, ranks), 1e-9 * total(1e9 * measure_fma(team), ranks)};
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

SearchCost measure_search(Simulation& simulation, ThreadTeam& team) {
  const Contact& contact = simulation.contact();
  SearchCost cost;
  const double reach = contact.margin + max_contact_offset(simulation.model()); // as in a run
  cost.seconds = median_time(3, [&] { find_contact_candidates(simulation.model().surface(), reach, team); });
  const std::vector<double> before = contact.travel;
  simulation.advance();
  double travel = 0;
  for (std::size_t g = 0; g < before.size(); ++g) travel = std::max(travel, contact.travel[g] - before[g]);
  cost.steps = travel > 0 ? 0.9 * contact.margin / (2 * travel) : 1e300;
  return cost;
}

/// To be called between the forces and the advance of a step.
OutputCost measure_output(Simulation& simulation, const Scenario& scenario) {
  OutputCost cost;
  cost.row_seconds = median_time(3, [&] { simulation.observe(); });
  const auto scratch = std::filesystem::temp_directory_path() / fmt::format("mpfem-bench-{}.checkpoint.h5", getpid());
  const Communicator& ranks = simulation.ranks();
  cost.checkpoint_seconds = median_time(1, [&] { save_checkpoint(scratch.string(), simulation, RunRecord{}, ranks); });
  if (ranks.is_root()) cost.checkpoint_bytes = static_cast<double>(std::filesystem::file_size(scratch));
  std::error_code ignored;
  std::filesystem::remove(scratch, ignored);
  cost.steps_per_row = simulation.stage_run().expected_duration() /
                       (simulation.step_estimate().stable_step() * static_cast<double>(scenario.output.history_rows));
  cost.checkpoint_interval = scenario.output.checkpoint_interval;
  return cost;
}

/// Contact points of nodes of the rank's own grains.
struct OwnPoints {
  double active = 0;
  std::int64_t candidates = 0;
};
OwnPoints count_own_points(const Model& model, const Contact& contact) {
  OwnPoints own;
  for (std::size_t pair = 0; pair < contact.active.size(); ++pair) {
    if (!model.ownership.owns(contact.candidates.pair_first[pair])) continue;
    own.active += contact.active[pair];
    own.candidates += contact.candidates.pair_point_offset[pair + 1] - contact.candidates.pair_point_offset[pair];
  }
  return own;
}

/// Collective. To be called between the forces and the advance of a step.
BenchScene describe(Simulation& simulation, const Scenario& scenario, const BenchOptions& options) {
  const Model& model = simulation.model();
  const OwnPoints points = count_own_points(model, simulation.contact());
  const HistoryRow row = simulation.observe();
  return {.element = element_name(scenario.numerics.element),
          .precision = precision_name(scenario.numerics.precision),
          .ranks = simulation.ranks().size(),
          .threads = options.threads,
          .lanes = with_tet_numbers(model, [](auto number) { return TetBlock<decltype(number)>::lanes; }),
          .tets = model.tets(),
          .grains = model.grains,
          .steps = options.steps,
          .relative_density = row.relative_density,
          .bonds = row.bonds,
          .contact_points = total(points.active, simulation.ranks()),
          .candidate_points =
              static_cast<std::int64_t>(total(static_cast<double>(points.candidates), simulation.ranks()))};
}

/// The model to measure. Sets the scenario; if the packing is built in, also its end.
Model make_model(const BenchOptions& options, Scenario& scenario, const Communicator& ranks) {
  if (options.scenario) {
    scenario = *options.scenario;
    Model model = build_model(read_packing(scenario.packing_file, ranks), scenario, scenario.packing_file, ranks);
    check_bonds(model, scenario, ranks);
    return model;
  }
  scenario = built_in_scenario(options);
  DensePacking dense = make_dense_packing(options.tets, options.grains, 1);
  divide(dense.packing, ranks);
  Model model = build_model(dense.packing, scenario, scenario.packing_file, ranks);
  scenario.stages[0].type = IsotropicCompaction{std::min(0.999, 1.15 * dense.relative_density), 1.0, 0.01};
  return model;
}

/// Takes the simulation to the state that is measured: the checkpoint `options.from`, or a packing that has begun to
/// flow.
void prepare(const BenchOptions& options, Scenario& scenario, Simulation& simulation) {
  if (!options.scenario) {
    set_initial_hardening(simulation.model_to_disturb());
    approach_affinely(simulation, scenario);
  }
  if (options.from) begin_branch(*options.from, simulation, simulation.ranks());
  const StageRun::State& stage = simulation.stage_run().state();
  check_stages(scenario, simulation.state().stage, stage.start, simulation.model(),
               simulation.step_estimate().stable_step());
  const int steps = options.scenario ? 20 : warm_up_steps;
  for (int i = 0; i < steps && !simulation.stage_complete(); ++i) {
    simulation.evaluate_forces();
    simulation.advance();
  }
}

/// Collective. What a step consists of. Searches and the work of contact are measured with one rank only: several ranks
/// send each other what these need.
template <class Say>
void measure_parts(Simulation& simulation, ThreadTeam& team, BenchResult& result, const Say& say) {
  const Model& model = simulation.model();
  const Communicator& ranks = simulation.ranks();
  if (ranks.alone()) {
    result.contact = work_of_contact(simulation.contact());
    result.search_work = work_of_search(model, simulation.contact().candidates);
    result.search = measure_search(simulation, team);
  }
  say("measuring the element forces");
  const double step = simulation.step_estimate().stable_step();
  result.elements = measure_elements(simulation.model_to_disturb(), step, team, ranks);
  say("measuring the machine");
  result.machine = measure_machine(team, ranks);
  result.tet = work_of_tet(model);
  result.integration = work_of_integration(model);
}

} // namespace

void run_bench(const BenchOptions& options, const Communicator& ranks) {
  ThreadTeam team(options.threads);
  const auto say = [&](const std::string& text) {
    if (ranks.is_root() && !options.quiet && !options.json) fmt::print(stderr, "{}\n", text);
  };
  Scenario scenario;
  Model made = make_model(options, scenario, ranks);
  Simulation simulation(std::move(made), scenario, team, options.from.has_value(), ranks);
  const Model& model = simulation.model();
  say(fmt::format("{} tetrahedra in {} grains; warming up", model.tets(), model.grains));
  prepare(options, scenario, simulation);

  BenchResult result;
  say("measuring steps");
  const RankTotals before(simulation);
  result.step = measure_steps(simulation, options.steps);
  if (!ranks.alone()) result.ranks = cost_of_ranks(simulation, before);
  simulation.evaluate_forces();
  result.scene = describe(simulation, scenario, options);
  result.output = measure_output(simulation, scenario);
  result.memory_of_root = peak_memory(); // before the arrays of the triad, which may be larger than the packing
  result.memory = total(result.memory_of_root, ranks);
  measure_parts(simulation, team, result, say);
  fmt::print("{}", options.json ? json_text(result) : table_text(result));
}

} // namespace mpfem
