#include "solver/run/resume.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/table_reader.hpp"
#include "solver/output/other_scenario.hpp"
#include "solver/parallel/agree.hpp"
#include "solver/scenario/read_scenario.hpp"

namespace mpfem {

namespace {

/// The scenario of the run that wrote a checkpoint.
Scenario scenario_of(const CheckpointReader& checkpoint) {
  return read_scenario(TomlDocument::from_text(checkpoint.scenario_text(), checkpoint.path()));
}

/// Whether two shapes are the same; the triangles of STL files are compared elsewhere (Tools::read), and their names do
/// not matter.
bool same_shape(ToolShape x, ToolShape y) {
  for (ToolShape* shape : {&x, &y})
    if (auto* stl = std::get_if<StlShape>(shape)) stl->file.clear();
  return x == y;
}

/// Refuses a scenario that does not begin with the tools of the one before; their friction may differ, and more tools
/// may follow.
void check_tools(const std::string& checkpoint, const Scenario& before, const Scenario& now) {
  const std::string as_before =
      fmt::format("as in {}; a branch begins with the tools of the checkpoint", one_line(checkpoint));
  for (std::size_t i = 0; i < before.tools.size(); ++i) {
    const ToolParameters& tool = before.tools[i];
    if (i >= now.tools.size())
      throw InputError(fmt::format("{}: the checkpoint has the tool '{}', the scenario has not, allowed: a scenario "
                                   "that begins with the tools of the checkpoint",
                                   one_line(checkpoint), tool.name));
    const ToolParameters& own = now.tools[i];
    const auto refuse = [&](const char* key, const std::string& finding) {
      throw InputError(fmt::format("{}key 'tools.{}.{}': {}", own.places.prefix(key), i, key, finding));
    };
    if (own.name != tool.name)
      refuse("name", fmt::format("found '{}', allowed: '{}', {}", own.name, tool.name, as_before));
    if (!same_shape(own.shape, tool.shape))
      refuse("type", fmt::format("the shape or place of the tool '{}' differs, allowed: {}", own.name, as_before));
    if (own.adhesion != tool.adhesion)
      refuse("adhesion", fmt::format("that of the tool '{}' differs, allowed: {}", own.name, as_before));
  }
  if (before.container != now.container)
    throw InputError(fmt::format("{}: the checkpoint's [container] differs from the scenario's, allowed: the same",
                                 one_line(checkpoint)));
}

/// Refuses what a branch must not change. A branch continues with the same material: stresses and strains mean nothing
/// in another one.
void check_branch(const CheckpointReader& checkpoint, bool bonded, const Scenario& before, const Scenario& now) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", one_line(checkpoint.path()), what));
  };
  if (before.material != now.material || before.grain_materials != now.grain_materials)
    refuse("the checkpoint's material differs from the scenario's, allowed: the same [material]");
  if (now.initial_velocity != std::array<double, 3>{} || !now.grain_velocity.empty() ||
      !now.grain_angular_velocity.empty())
    refuse("[initial] cannot be used in a run that begins at a checkpoint: grains keep the velocities that they have "
           "there");
  check_tools(checkpoint.path(), before, now);
  // The separations of a damaged bond depend on its stiffness, which follows from the penalty.
  const bool sticky = std::ranges::any_of(before.tools, [](const auto& tool) { return tool.adhesion.has_value(); });
  if ((bonded || sticky) && before.contact.penalty_differs(now.contact))
    refuse("the checkpoint's bonds were formed with another penalty than the scenario's, allowed: the same "
           "contact.stiffness and contact.stiffness_factor");
  if (!bonded) return;
  // Bonds keep the law by which they formed, and [bond] is the law of future bonds. Whether bonds resist sliding
  // decides how all bonds are tracked.
  if (!now.bond) refuse("the checkpoint has bonds, the scenario has none, allowed: a [bond] with the same normal_only");
  if (before.bond->normal_only != now.bond->normal_only)
    refuse("the checkpoint's bonds were formed with another bond.normal_only, allowed: a [bond] with the same "
           "normal_only");
}

/// Restores the state; for a `branch`, as that of the scenario's first stage. `bonded`: with bonds.
void restore(const CheckpointReader& checkpoint, bool bonded, const Scenario& before, Simulation& simulation,
             RunRecord& record, bool branch, const Communicator& ranks) {
  if (bonded && !before.bond)
    throw InputError(
        fmt::format("{}: the checkpoint is damaged: it has bonds, its scenario has none", one_line(checkpoint.path())));
  const FieldValues values = checkpoint.fields();
  FieldReader fields(values);
  try {
    simulation.restore(
        fields, branch ? std::optional(before.tools.size()) : std::nullopt, [&](const Simulation::Arrays& arrays) {
          agree(ranks, [&] { // what follows on all ranks needs all of them
            checkpoint.take_arrays(arrays.model, arrays.contact, arrays.wall_friction, arrays.tools, arrays.grain_steps,
                                   arrays.grips, bonded ? before.bond : std::nullopt);
          });
        });
    if (branch) return; // a branch has its own record
    RunRecord::for_each_field(record, fields);
    fields.finish();
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: the checkpoint was written by another version of mpfem ({})",
                                 one_line(checkpoint.path()), error.what()));
  }
}

} // namespace

void save_checkpoint(const std::string& path, const Simulation& simulation, const RunRecord& record,
                     const Communicator& ranks) {
  FieldWriter fields;
  simulation.write(fields);
  RunRecord::for_each_field(record, fields);
  write_checkpoint(path,
                   {simulation.model(), simulation.contact(), simulation.wall_friction(), simulation.tools(),
                    simulation.grips(), simulation.step_estimate().grain_steps(), fields.values()},
                   record, simulation.scenario().text, ranks);
}

void resume(const std::string& path, Simulation& simulation, RunRecord& record, const Communicator& ranks) {
  const CheckpointReader checkpoint(path);
  checkpoint.check_model(simulation.model(), ranks);
  if (checkpoint.scenario_text() != simulation.scenario().text)
    throw InputError(
        fmt::format("{}: the checkpoint belongs to another scenario{}; run without --resume to start again",
                    one_line(path), scenario_difference(checkpoint.scenario_text(), simulation.scenario().text)));
  record = checkpoint.record();
  restore(checkpoint, checkpoint.has_bonds(), simulation.scenario(), simulation, record, false, ranks);
}

void begin_branch(const std::string& path, Simulation& simulation, const Communicator& ranks) {
  const CheckpointReader checkpoint(path);
  checkpoint.check_model(simulation.model(), ranks);
  const Scenario before = scenario_of(checkpoint);
  const bool bonded = checkpoint.has_bonds();
  check_branch(checkpoint, bonded, before, simulation.scenario());
  RunRecord earlier;
  restore(checkpoint, bonded, before, simulation, earlier, true, ranks);
  try {
    simulation.begin_branch(before.gravity);
  } catch (const SimulationError& error) { // what the scenario wants is not possible with this sample
    throw InputError(fmt::format("{}the sample of {}: {}", simulation.scenario().stages.front().places.prefix("type"),
                                 one_line(path), error.what()));
  }
}

} // namespace mpfem
