#include "solver/run/check_scenario.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/parallel/root.hpp"
#include "solver/run/make_tools.hpp"
#include "solver/run/needs.hpp"
#include "solver/run/plan_text.hpp"
#include "solver/run/plausibility.hpp"
#include "solver/run/resume.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/stage_forecast.hpp"
#include "surfaces/stl.hpp"

namespace mpfem {

namespace {

// If a packing begins loose, later steps cost more: points come into contact, and tets that yield need the whole
// element pass. The cost of stable-step estimates and contact searches follows the deformation, not the number of
// steps. All these costs, and how the step shrinks, are measured (docs/performance.md).
constexpr double dense_cost = 1.45;         // of a step, over that in the loose packing
constexpr double cost_of_straining = 3000;  // of a length strain of 1, in steps of the loose packing
constexpr double steps_of_shrinking = 1.02; // over those at the first step, on the way to a relative density of 0.92
constexpr double density_of_jamming = 0.5;

/// Number of steps, and their time in units of one step at the start.
struct StageWork {
  double steps = 0, cost = 0;
};

/// A compaction whose grains do not press on each other at the start.
StageWork work_of_first_compaction(double steps, double density, double end) {
  const auto strain_to = [density](double to) { return to > density ? std::log(to / density) / 3 : 0.0; };
  const auto way_to = [density](double to) { return to > density ? 1 - std::cbrt(density / to) : 0.0; };
  const double flying = std::min(way_to(density_of_jamming) / way_to(end), 1.0); // fraction of the steps
  const double straining = std::max(strain_to(end) - strain_to(density_of_jamming), 0.0);
  steps *= steps_of_shrinking;
  return {steps, steps * (flying + (1 - flying) * dense_cost) + cost_of_straining * straining};
}

/// A branch begins dense: its first steps cost as much as all others.
std::vector<StageWork> work_of_stages(const Scenario& scenario, const std::vector<StageForecast>& forecasts,
                                      const Simulation& simulation) {
  bool loose = simulation.energies().plastic_dissipation == 0 && simulation.box().mean_stress() == 0;
  double growth = 1;
  std::vector<StageWork> works;
  for (std::size_t s = 0; s < forecasts.size(); ++s) {
    const StageType& type = scenario.stages[s].type;
    const auto* compaction = std::get_if<IsotropicCompaction>(&type);
    const bool loads = moves_walls(type) && !std::holds_alternative<IsotropicUnloading>(type);
    const double steps = forecasts[s].duration / simulation.step_estimate().stable_step();
    if (loose && compaction) {
      works.push_back(work_of_first_compaction(steps, simulation.relative_density(), compaction->relative_density));
    } else {
      if (loose && loads) growth = dense_cost;
      works.push_back({steps, steps * growth});
    }
    if (loose && loads) loose = false, growth = dense_cost;
  }
  return works;
}

/// Wall-clock time here, s.
struct MeasuredTimes {
  double step = 0;
  double row = 0; ///< of the history
};

/// The mean of some steps, by which the simulation advances.
MeasuredTimes measure(Simulation& simulation) {
  MeasuredTimes times;
  int steps = 0;
  const auto start = Profile::Clock::now();
  try {
    const auto enough = [&] { // as soon as one rank has them: all stop at the same step
      return simulation.ranks().largest(steps >= 20 && Profile::since(start) >= 0.5 ? 1 : 0) > 0;
    };
    for (; steps < 200 && !enough() && !simulation.stage_complete(); ++steps) {
      simulation.evaluate_forces();
      if (steps == 0) {
        const auto start_of_row = Profile::Clock::now();
        simulation.observe();
        times.row = Profile::since(start_of_row);
      }
      simulation.advance();
    }
  } catch (const SimulationError& error) {
    fmt::print("warning        a step failed: {}\n", error.what());
  }
  times.step = (Profile::since(start) - times.row) / std::max(steps, 1);
  return times;
}

void print_tool(const ToolParameters& tool) {
  fmt::print("tool           '{}', {}, friction {:g}\n", tool.name, shape_name(tool.shape), tool.friction);
  if (const auto* stl = std::get_if<StlShape>(&tool.shape))
    fmt::print("               {}: {}\n", stl->file, describe(read_stl(stl->file, stl->scale).findings));
}

/// What the packing is, and what it needs.
void print_model(const Scenario& scenario, const Simulation& simulation, const Needs& needs, int ranks) {
  const Model& model = simulation.model();
  fmt::print("packing        {}: {} grains, {} tets, {} nodes, {} facets\n", scenario.packing_file, model.grains,
             model.tets(), model.nodes(), model.facets());
  fmt::print("elements       {}, {} precision\n", element_name(scenario.numerics.element),
             precision_name(scenario.numerics.precision));
  fmt::print("contact        by {}\n",
             model.smooth_grains == 0 ? "the facets of the grains' meshes"
             : model.smooth_grains == model.grains
                 ? "the grains' smooth surfaces"
                 : fmt::format("the smooth surfaces of {} grains, facets of the others", model.smooth_grains));
  if (scenario.has_friction())
    fmt::print("friction       {:g} between grains{}\n", scenario.contact.friction,
               scenario.walls ? fmt::format(", {:g} at walls", scenario.wall_friction) : "");
  for (const MaterialPair& pair : scenario.contact.pairs)
    fmt::print("               {:g} between materials {} and {}\n", pair.friction, pair.materials[0],
               pair.materials[1]);
  for (const ToolParameters& tool : scenario.tools) print_tool(tool);
  fmt::print("density        {:.4f} (relative density at the start)\n", simulation.relative_density());
  fmt::print("memory         {:.1f} MB of model data ({:.0f} bytes per tetrahedron); {} needs about {:.0f} MB at most, "
             "and {}{:.0f} MB of disk space\n",
             1e-6 * static_cast<double>(model.memory()), static_cast<double>(model.memory()) / model.tets(),
             ranks > 1 ? fmt::format("each of {} ranks", ranks) : "the run", 1e-6 * needs.memory,
             ranks > 1 ? "all together " : "", 1e-6 * needs.disk);
}

void print_step(const StepEstimate::State& step) {
  fmt::print("stable step    {:.4g} s, set by {}\n", step.stable_step,
             step.controlled_by_contact ? "contact" : "elements");
}

void print_bonds(const Scenario& scenario, const Simulation& simulation) {
  if (scenario.bond) {
    const BondResolution r =
        bond_resolution(simulation.model(), *scenario.bond, scenario.contact, BondPartner::grain, simulation.ranks());
    fmt::print(
        "bonds          cohesive zone {:.3g} mm, {:.2g} elements of {:.3g} mm; fracture energy {:g} N/mm, needed "
        "for stable softening {:.3g} N/mm, for any softening more than {:.3g} N/mm\n",
        r.cohesive_zone, r.cohesive_zone / r.element_size, r.element_size, scenario.bond->fracture_energy,
        r.steep_fracture_energy, r.smallest_fracture_energy);
  }
  if (const std::string text = earlier_bonds_text(simulation.contact()); !text.empty())
    fmt::print("               {}\n", text);
}

/// The stages, and how long they take on this machine. Advances the simulation by some steps.
void print_stages(const Scenario& scenario, Simulation& simulation, int threads, int ranks) {
  const auto forecasts = forecast(scenario, 0, simulation.stage_run().state().start, simulation.model());
  const auto works = work_of_stages(scenario, forecasts, simulation);
  StageWork all;
  for (std::size_t s = 0; s < works.size(); ++s) {
    all.steps += works[s].steps;
    all.cost += works[s].cost;
    fmt::print("stage          {}: {}{:.4g} s, {:.0f} steps; {}\n", scenario.stages[s].name,
               forecasts[s].end_is_known ? "" : "about ", forecasts[s].duration, works[s].steps,
               forecasts[s].description);
  }
  const MeasuredTimes measured = measure(simulation);
  const double rows = scenario.output.history_rows * static_cast<double>(works.size()) * measured.row;
  const std::string of_ranks = ranks > 1 ? fmt::format(" of each of {} ranks", ranks) : "";
  fmt::print("estimate       {:.3g} ms per step measured here on {} thread{}{}; {:.0f} steps: {}, with an average step "
             "of {:.3g} ms and {:.2g} s for the history\n",
             1e3 * measured.step, threads, threads == 1 ? "" : "s", of_ranks, all.steps,
             wall_time_text(all.cost * measured.step + rows),
             1e3 * measured.step * (all.steps > 0 ? all.cost / all.steps : 1), rows);
}

} // namespace

void check_scenario(const Scenario& scenario, const CheckOptions& options, const Communicator& ranks) {
  Needs needs;
  std::vector<std::string> warnings;
  root_does(ranks, [&] { needs = needs_of(scenario, ranks.size()); });
  if (const std::string scarce = check_memory(scenario.packing_file, needs.memory, ranks); !scarce.empty())
    warnings.push_back(scarce);
  std::ranges::copy(implausible_values(scenario), std::back_inserter(warnings));
  ThreadTeam team(options.threads);
  Simulation simulation(build_model(read_packing(scenario.packing_file, ranks), scenario, scenario.packing_file, ranks),
                        scenario, team, options.from.has_value(), ranks);
  if (options.from) begin_branch(*options.from, simulation, ranks);
  std::ranges::copy(implausible_sizes(scenario, simulation.model(), simulation.tools()), std::back_inserter(warnings));
  std::ranges::copy(check_bonds(simulation.model(), scenario, ranks), std::back_inserter(warnings));
  const StepEstimate::State& step = simulation.step_estimate().state();
  check_stages(scenario, 0, simulation.stage_run().state().start, simulation.model(), step.stable_step);
  if (!options.quiet) print_model(scenario, simulation, needs, ranks.size());
  for (const std::string& warning : warnings) fmt::print("warning        {}\n", warning);
  if (options.quiet) return;
  print_step(step);
  if (const std::string text = mass_scaling_text(scenario, simulation.model()); !text.empty())
    fmt::print("masses         {}\n", text);
  print_bonds(scenario, simulation);
  print_stages(scenario, simulation, options.threads, ranks.size());
}

} // namespace mpfem
