#include "solver/run/check_scenario.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/run/plan_text.hpp"
#include "solver/run/programme.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

namespace {

/// What a stage does, for the plan.
std::string stage_text(const Stage& stage) {
  if (stage.isotropic_compaction) return "all walls inwards, to a relative density";
  if (stage.isotropic_unloading) return "all walls outwards, to a mean stress";
  if (stage.grip) return "grips, to a displacement";
  if (stage.hold) return "walls at rest, for a time";
  switch (stage.loading->path) {
  case LoadingPath::isotropic:
    return "all walls inwards, to a mean stress";
  case LoadingPath::cycles:
    return fmt::format("all walls, {} cycles between two mean stresses", stage.loading->cycles);
  case LoadingPath::unconfined:
    return "z walls driven, x and y walls away";
  case LoadingPath::triaxial:
    return fmt::format("z walls driven, x and y walls held at constant {}",
                       stage.loading->hold_force ? "force" : "stress");
  case LoadingPath::die:
    return "z walls driven, x and y walls at rest";
  case LoadingPath::probe:
    return "all walls held on a straight path of p and q";
  case LoadingPath::held:
    return fmt::format("all walls held at {:g} MPa, for a time", stage.loading->held_stress);
  }
  return {};
}

} // namespace

void check_scenario(const Scenario& scenario, int threads, const std::optional<std::string>& from) {
  ThreadTeam team(threads);
  Simulation simulation(build_model(read_packing(scenario.packing_file), scenario, scenario.packing_file), scenario,
                        team, from.has_value());
  if (from) begin_branch(*from, simulation, scenario.text);
  const RunState& state = simulation.state();
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
  fmt::print("relative density at the start  {:.4f}\n", simulation.relative_density());
  fmt::print("memory         {:.1f} MB of model data ({:.0f} B a tet)\n", 1e-6 * static_cast<double>(model.memory()),
             static_cast<double>(model.memory()) / model.tets());
  fmt::print("stable step    {:.4g} s, set by {}\n", state.stable_step,
             state.controlled_by_contact ? "contact" : "elements");

  if (const std::string text = mass_scaling_text(scenario, model); !text.empty())
    fmt::print("masses         {}\n", text);
  const auto warnings = check_bonds(model, scenario);
  if (scenario.bond) {
    const BondResolution r = bond_resolution(model, scenario);
    fmt::print(
        "bonds          cohesive zone {:.3g} mm, {:.2g} elements of {:.3g} mm; fracture energy {:g} N/mm, softening "
        "as steep as the elements at {:.3g}, none left at {:.3g} N/mm\n",
        r.cohesive_zone, r.cohesive_zone / r.element_size, r.element_size, scenario.bond->fracture_energy,
        r.steep_fracture_energy, r.smallest_fracture_energy);
  }
  for (const std::string& warning : warnings) fmt::print("warning        {}\n", warning);
  if (const std::string text = earlier_bonds_text(simulation.contact()); !text.empty())
    fmt::print("               {}\n", text);
  check_programme(scenario, 0, state.stage_low, state.stage_high, model, state.stable_step);
  // The steps of all stages at the present stable step, and the time of a few steps measured here.
  const auto forecasts = forecast(scenario, 0, state.stage_low, state.stage_high, model);
  const double first_stable_step = state.stable_step;
  double steps = 0;
  for (std::size_t s = 0; s < forecasts.size(); ++s) {
    const double stage_steps = forecasts[s].duration / first_stable_step;
    steps += stage_steps;
    fmt::print("stage          {}: {}{:.4g} s, {:.0f} steps at the present step; {}\n", scenario.stages[s].name,
               forecasts[s].sure ? "" : "about ", forecasts[s].duration, stage_steps, stage_text(scenario.stages[s]));
  }
  int measured = 0;
  const auto start = Profile::Clock::now();
  try {
    for (; (measured < 20 || Profile::since(start) < 0.5) && measured < 200 && !simulation.stage_complete();
         ++measured) {
      simulation.evaluate_forces();
      simulation.advance();
    }
  } catch (const SimulationError& error) {
    fmt::print("warning        step {} failed: {}\n", measured, error.what());
  }
  const double seconds = Profile::since(start) / std::max(measured, 1);
  fmt::print("estimate       {:.3g} ms a step measured here on {} threads; {:.0f} steps: {:.0f} s. {}\n", 1e3 * seconds,
             threads, steps, seconds * steps,
             from ? "The step shrinks as tets flatten."
                  : "Dense packings take about half as long again (contact), and the step shrinks as tets flatten.");
}

} // namespace mpfem
