#include "solver/bench/bench.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/version.hpp"
#include "solver/bench/dense_packing.hpp"
#include "solver/bench/machine.hpp"
#include "solver/bench/work.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

namespace {

constexpr double strain_per_step = 5e-5; // linear, of the built-in packing: some four times that of a usual run
constexpr int warm_up_steps = 300;       // 1.5 % in length: contacts closed, grains flowing
constexpr double strain_before = 0.02;   // plastic strain from which the built-in packing hardens on

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
  scenario.numerics.element = options.element;
  scenario.numerics.own_pressure = usual_own_pressure(options.element);
  scenario.numerics.precision = options.precision;
  Stage stage;
  stage.name = "compaction";
  stage.isotropic_compaction.emplace();
  scenario.stages.push_back(stage);
  return scenario;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// Grains that have been strained before, as those of a compact have.
void strain_before_hand(Model& model) {
  const auto* law = std::get_if<PowerLaw>(&model.material_of(0).flow);
  const double flow_stress = law->yield_stress + law->coefficient * std::pow(strain_before, law->exponent);
  std::visit(
      [&](auto& blocks) {
        for (auto& block : blocks) {
          std::fill(std::begin(block.plastic_strain), std::end(block.plastic_strain), strain_before);
          std::fill(std::begin(block.flow_stress), std::end(block.flow_stress), flow_stress);
        }
      },
      model.blocks);
}

/// Walls and grains approach by one affine motion from the start on.
void approach_affinely(Simulation& simulation, Scenario& scenario) {
  Model& model = simulation.model();
  const double rate = strain_per_step / simulation.state().stable_step;
  scenario.stages[0].isotropic_compaction->wall_speed =
      0.5 * rate * *std::max_element(model.box_high.begin(), model.box_high.end());
  simulation.begin_stage();
  for (std::size_t n = 0; n < model.position.size(); n += 4)
    for (std::size_t axis = 0; axis < 3; ++axis)
      model.velocity[n + axis] = -rate * (model.position[n + axis] - 0.5 * model.box_high[axis]);
}

/// In ns per tet and step.
struct StepCost {
  double whole = 0;
  std::array<double, profile_parts> part{};
};

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
    if (taken == 0) throw InputError("mpfem bench: the stage ends before the steps to measure, allowed fewer --steps");
    const double scale = 1e9 / (taken * tets);
    segment.whole = scale * Profile::since(start);
    for (std::size_t p = 0; p < profile_parts; ++p)
      segment.part[p] =
          scale * (simulation.profile().seconds(static_cast<Part>(p)) - before.seconds(static_cast<Part>(p)));
  }
  std::sort(segments.begin(), segments.end(), [](const StepCost& x, const StepCost& y) { return x.whole < y.whole; });
  return segments[1];
}

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

/// Work over the time that it took.
struct Rate {
  Rate(const Work& work, double nanoseconds)
      : bytes(work.bytes / nanoseconds), operations(work.operations / nanoseconds) {}
  double bytes;      ///< GB/s
  double operations; ///< GFlop/s
};

/// The element pass alone, over all grains, while most tets harden: grains shear at the rate of the warm-up.
struct ElementCost {
  double nanoseconds = 0; ///< per tet and step
  double hardening = 0;   ///< part of the tets that yielded in the last pass
};

ElementCost measure_elements(Model& model, double step, ThreadTeam& team) {
  for (int g = 0; g < model.grains; ++g) {
    const auto gs = static_cast<std::size_t>(g);
    for (auto n = static_cast<std::size_t>(model.node_offset[gs]);
         n < static_cast<std::size_t>(model.node_offset[gs + 1]); ++n) {
      const double rate = strain_per_step / step;
      const double* x = &model.position[4 * n];
      double* v = &model.velocity[4 * n];
      v[0] = rate * x[0], v[1] = -0.5 * rate * x[1], v[2] = -0.5 * rate * x[2];
    }
  }
  const auto pass = [&] { team.for_each(model.grains, [&](int g, int) { element_forces(model, g, step); }); };
  for (int i = 0; i < 200; ++i) pass();
  ElementCost cost;
  cost.nanoseconds = 1e9 * median_time(31, pass) / model.tets();
  const auto strains = [&] {
    std::vector<double> all;
    std::visit(
        [&](const auto& blocks) {
          for (const auto& block : blocks)
            all.insert(all.end(), std::begin(block.plastic_strain), std::end(block.plastic_strain));
        },
        model.blocks);
    return all;
  };
  const std::vector<double> before = strains();
  pass();
  const std::vector<double> after = strains();
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) moved += after[i] > before[i] ? 1U : 0U;
  cost.hardening = static_cast<double>(moved) / static_cast<double>(before.size());
  return cost;
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::string json_text(const std::vector<std::pair<std::string, std::string>>& fields) {
  std::string text = "{";
  for (std::size_t i = 0; i < fields.size(); ++i)
    text += fmt::format("{}\n  \"{}\": {}", i > 0 ? "," : "", fields[i].first, fields[i].second);
  return text + "\n}\n";
}

} // namespace

void run_bench(const BenchOptions& options) {
  ThreadTeam team(options.threads);
  const auto say = [&](const std::string& text) {
    if (!options.quiet && !options.json) fmt::print(stderr, "{}\n", text);
  };
  // 1. The state to measure.
  Scenario scenario;
  Model model;
  if (options.scenario) {
    scenario = *options.scenario;
    model = build_model(read_packing(scenario.packing_file), scenario, scenario.packing_file);
    check_bonds(model, scenario);
  } else {
    scenario = built_in_scenario(options);
    const DensePacking dense = make_dense_packing(options.tets, options.grains, 1);
    model = build_model(dense.packing, scenario, scenario.packing_file);
    scenario.stages[0].isotropic_compaction = {std::min(0.999, 1.15 * dense.relative_density), 1.0, 0.01};
  }
  Simulation simulation(std::move(model), scenario, team, options.from.has_value());
  const bool built_in = !options.scenario;
  if (built_in) {
    strain_before_hand(simulation.model());
    approach_affinely(simulation, scenario);
  }
  if (options.from) begin_branch(*options.from, simulation, scenario.text);
  const RunState& state = simulation.state();
  check_programme(scenario, state.stage, state.stage_low, state.stage_high, simulation.model(), state.stable_step);
  say(fmt::format("{} tets in {} grains; warming up", simulation.model().tets(), simulation.model().grains));
  const int warm_up = built_in ? warm_up_steps : 20;
  for (int i = 0; i < warm_up && !simulation.stage_complete(); ++i) {
    simulation.evaluate_forces();
    simulation.advance();
  }

  // 2. Whole steps.
  say("measuring steps");
  const StepCost cost = measure_steps(simulation, options.steps);
  simulation.evaluate_forces();
  const Contact& contact = simulation.contact();
  const double tets = simulation.model().tets();
  const double points = std::accumulate(contact.active.begin(), contact.active.end(), 0.0);
  const Work contact_work = work_of_contact(contact),
             search_work = work_of_search(simulation.model(), contact.candidates);
  const auto per_tet = [&](double seconds) { return 1e9 * seconds / tets; };
  const HistoryRow row = simulation.observe();
  const double row_time = median_time(3, [&] { simulation.observe(); });
  const auto scratch = std::filesystem::temp_directory_path() / fmt::format("mpfem-bench-{}.checkpoint.h5", getpid());
  const double checkpoint_time =
      median_time(1, [&] { write_checkpoint(scratch.string(), simulation, RunRecord{}, scenario.text); });
  std::error_code ignored;
  const auto checkpoint_bytes = static_cast<double>(std::filesystem::file_size(scratch));
  std::filesystem::remove(scratch, ignored);

  // 3. The search: its time, and how many steps one lasts at the grains' present speeds.
  const double search_time =
      median_time(3, [&] { find_contact_candidates(simulation.model().surface(), contact.margin, team); });
  double travel = 0;
  const std::vector<double> before = contact.travel;
  simulation.advance();
  for (std::size_t g = 0; g < before.size(); ++g) travel = std::max(travel, contact.travel[g] - before[g]);
  const double steps_per_search = travel > 0 ? 0.9 * contact.margin / (2 * travel) : 1e300;
  const double search = per_tet(search_time) / std::max(steps_per_search, 1.0);
  // Output over the steps between two rows of the history, and checkpoints over the time between two.
  const double steps_per_row =
      simulation.stage_duration() / (state.stable_step * static_cast<double>(scenario.output.history_rows));
  const double output = per_tet(row_time) / std::max(steps_per_row, 1.0) +
                        cost.whole * checkpoint_time / std::max(scenario.output.checkpoint_interval, 1.0);
  const double memory = peak_memory();

  // 4. The element pass alone.
  say("measuring the element pass");
  const ElementCost elements = measure_elements(simulation.model(), simulation.state().stable_step, team);
  say("measuring the machine");
  const double triad = measure_triad(team), fma = measure_fma(team);
  const Work tet = work_of_tet(simulation.model()), integration = work_of_integration(simulation.model());
  const int lanes = with_tet_numbers(simulation.model(), [](auto number) { return TetBlock<decltype(number)>::lanes; });
  const char* precision = precision_name(scenario.numerics.precision);
  const auto part = [&](Part p) { return cost.part[static_cast<std::size_t>(p)]; };
  const Rate element_rate(tet, elements.nanoseconds), contact_rate(contact_work, tets * part(Part::contact)),
      search_rate(search_work, 1e9 * search_time), integration_rate(integration, tets * part(Part::integration));
  const double checkpoint_speed = 1e-9 * checkpoint_bytes / checkpoint_time;

  if (options.json) {
    const auto number = [](double value) { return fmt::format("{:.6g}", value); };
    fmt::print("{}", json_text({
                         {"version", fmt::format("\"{}\"", version())},
                         {"element", fmt::format("\"{}\"", element_name(scenario.numerics.element))},
                         {"threads", std::to_string(options.threads)},
                         {"precision", fmt::format("\"{}\"", precision)},
                         {"lanes", std::to_string(lanes)},
                         {"tets", std::to_string(simulation.model().tets())},
                         {"grains", std::to_string(simulation.model().grains)},
                         {"relative_density", number(row.relative_density)},
                         {"bonds", number(row.bonds)},
                         {"contact_points", number(points)},
                         {"candidate_points", std::to_string(contact.candidates.point_node.size())},
                         {"steps", std::to_string(options.steps)},
                         {"element_pass_ns_per_tet_step", number(elements.nanoseconds)},
                         {"element_pass_hardening_fraction", number(elements.hardening)},
                         {"element_pass_GB_per_s", number(element_rate.bytes)},
                         {"element_pass_GFlop_per_s", number(element_rate.operations)},
                         {"flop_per_tet_step", number(tet.operations)},
                         {"bytes_per_tet_step", number(tet.bytes)},
                         {"elements_ns_per_tet_step", number(part(Part::elements))},
                         {"contact_ns_per_tet_step", number(part(Part::contact))},
                         {"contact_ns_per_point", number(points > 0 ? part(Part::contact) * tets / points : 0.0)},
                         {"contact_GB_per_s", number(contact_rate.bytes)},
                         {"contact_GFlop_per_s", number(contact_rate.operations)},
                         {"search_ns_per_tet_step", number(search)},
                         {"search_ns_per_point_step", number(points > 0 ? search * tets / points : 0.0)},
                         {"search_GB_per_s", number(search_rate.bytes)},
                         {"search_GFlop_per_s", number(search_rate.operations)},
                         {"search_ms", number(1e3 * search_time)},
                         {"steps_per_search", number(steps_per_search)},
                         {"integration_ns_per_tet_step", number(part(Part::integration))},
                         {"integration_GB_per_s", number(integration_rate.bytes)},
                         {"integration_GFlop_per_s", number(integration_rate.operations)},
                         {"surface_ns_per_tet_step", number(part(Part::surface))},
                         {"step_estimate_ns_per_tet_step", number(part(Part::step_estimate))},
                         {"whole_step_ns_per_tet_step", number(cost.whole)},
                         {"output_ns_per_tet_step", number(output)},
                         {"history_row_ns_per_tet", number(per_tet(row_time))},
                         {"checkpoint_ns_per_tet", number(per_tet(checkpoint_time))},
                         {"checkpoint_GB_per_s", number(checkpoint_speed)},
                         {"checkpoint_bytes_per_tet", number(checkpoint_bytes / tets)},
                         {"memory_bytes_per_tet", number(memory / tets)},
                         {"triad_GB_per_s", number(triad)},
                         {"fma_GFlop_per_s", number(fma)},
                     }));
    return;
  }
  fmt::print("machine        {} threads, packs of {} doubles: triad {:.1f} GB/s, fused multiply-add {:.1f} GFlop/s\n",
             options.threads, native_lanes, triad, fma);
  fmt::print("scene          {} {} tets ({} precision, packs of {}) in {} grains, D_r {:.3f}, {:.0f} contact points of "
             "{} candidates, {:.0f} bonds\n",
             simulation.model().tets(), element_name(scenario.numerics.element), precision, lanes,
             simulation.model().grains, row.relative_density, points, contact.candidates.point_node.size(), row.bonds);
  fmt::print("memory         {:.0f} B a tet, {:.2f} GB at most, all in\n\n", memory / tets, 1e-9 * memory);
  fmt::print("element pass alone, {:.0f} % of the tets hardening: {:.2f} ns per tet-step\n\n", 100 * elements.hardening,
             elements.nanoseconds);
  fmt::print("{:<28} {:>12} {:>8} {:>14}\n", "whole step", "ns/tet-step", "share", "ns/point-step");
  double accounted = 0;
  const auto line = [&](const char* name, double value, bool per_point) {
    fmt::print("{:<28} {:>12.2f} {:>7.1f}% {:>14}\n", name, value, 100 * value / cost.whole,
               per_point && points > 0 ? fmt::format("{:.1f}", value * tets / points) : "");
  };
  for (const Part p :
       {Part::elements, Part::contact, Part::contact_search, Part::integration, Part::surface, Part::step_estimate}) {
    line(part_names[static_cast<std::size_t>(p)], part(p), p == Part::contact);
    accounted += part(p);
  }
  line("waiting and rest", cost.whole - accounted, false);
  line("total", cost.whole, false);
  line("a search over its steps", search, true);
  line("output over its steps", output, false);
  fmt::print("\n{:<28} {:>12} {:>13} {:>10} {:>13}\n", "at least moved and computed", "GB/s", "of the triad", "GFlop/s",
             "of the best");
  const auto rate_line = [&](const char* name, const Rate& rate) {
    fmt::print("{:<28} {:>12.1f} {:>11.0f} % {:>10.1f} {:>11.1f} %\n", name, rate.bytes, 100 * rate.bytes / triad,
               rate.operations, 100 * rate.operations / fma);
  };
  rate_line("element pass alone", element_rate);
  rate_line("contact forces", contact_rate);
  rate_line("contact search", search_rate);
  rate_line("integration", integration_rate);
  fmt::print("a tet: {:.0f} B, {:.0f} operations; a contact point, its bond and its sleeping neighbours: {:.0f} B; its "
             "penalty: {:.0f} operations\n\n",
             tet.bytes, tet.operations, points > 0 ? contact_work.bytes / points : 0.0,
             points > 0 ? contact_work.operations / points : 0.0);
  fmt::print(
      "search {:.2f} ms, lasts {:.0f} steps; history row {:.2f} ms; checkpoint {:.2f} s, {:.0f} B a tet, {:.2f} GB/s\n",
      1e3 * search_time, steps_per_search, 1e3 * row_time, checkpoint_time, checkpoint_bytes / tets, checkpoint_speed);
}

} // namespace mpfem
