#include "solver/scenario/read_scenario.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/table_reader.hpp"
#include "solver/scenario/common_keys.hpp"
#include "solver/scenario/ranges.hpp"
#include "solver/scenario/read_bond.hpp"
#include "solver/scenario/read_hardening.hpp"
#include "solver/scenario/read_stages.hpp"
#include "solver/scenario/read_tools.hpp"

namespace mpfem {

namespace {

constexpr double smallest_density_step = 0.001; // of checkpoints, whose names have three decimals

/// Does not call table.finish(): the table may hold more keys.
MaterialParameters read_material(TableReader& table) {
  MaterialParameters material;
  material.density = table.number("density", positive_density);
  material.youngs_modulus = table.number("youngs_modulus", positive_modulus);
  material.poissons_ratio = table.number("poissons_ratio", admissible_poissons_ratio);
  material.hardening = read_hardening(table.table("hardening"), material);
  return material;
}

std::vector<GrainMaterial> read_grain_materials(TableReader& root) {
  std::vector<GrainMaterial> materials;
  std::set<std::int64_t> seen;
  for (TableReader& table : root.tables("grain_material")) {
    GrainMaterial other;
    for (const std::int64_t grain : table.integers("grains", Range::between(0, most_grains))) {
      if (!seen.insert(grain).second)
        table.fail("grains", fmt::format("found {} twice, allowed: one material per grain", grain));
      other.grains.push_back(grain);
    }
    if (other.grains.empty()) table.fail("grains", "found no grain, allowed: at least one");
    other.material = read_material(table);
    table.finish();
    materials.push_back(std::move(other));
  }
  return materials;
}

/// [[contact.pair]]: each pair of materials once.
std::vector<MaterialPair> read_material_pairs(TableReader& contact, std::size_t materials) {
  std::vector<MaterialPair> pairs;
  std::set<std::array<std::size_t, 2>> seen;
  const auto last = static_cast<double>(materials) - 1;
  for (TableReader& table : contact.tables("pair")) {
    const std::vector<std::int64_t> both = table.integers("materials", Range::between(0, last));
    if (both.size() != 2) table.fail("materials", fmt::format("found {} numbers, allowed: two", both.size()));
    MaterialPair pair;
    pair.materials = {static_cast<std::size_t>(std::min(both[0], both[1])),
                      static_cast<std::size_t>(std::max(both[0], both[1]))};
    if (!seen.insert(pair.materials).second)
      table.fail("materials", fmt::format("found {} and {} twice, allowed: once", both[0], both[1]));
    pair.friction = table.number("friction", friction_or_zero);
    table.finish();
    pairs.push_back(pair);
  }
  return pairs;
}

ContactParameters read_contact(TableReader& table, std::size_t materials) {
  ContactParameters contact;
  contact.stiffness_factor = table.number_or("stiffness_factor", contact.stiffness_factor, stiffness_factors);
  if (table.has("stiffness")) {
    if (table.has("stiffness_factor")) table.fail("stiffness", "cannot be used with 'stiffness_factor'");
    contact.stiffness = table.number("stiffness", positive_stiffness);
  }
  contact.friction = table.number_or("friction", contact.friction, friction_or_zero);
  contact.pairs = read_material_pairs(table, materials);
  contact.search_margin = table.number_or("search_margin", contact.search_margin, Range::between(0.05, 2));
  const std::string surface = table.choice_or("surface", "automatic", {"automatic", "facets", "smooth"});
  contact.surface = surface == "smooth"   ? ContactSurface::smooth
                    : surface == "facets" ? ContactSurface::facets
                                          : ContactSurface::automatic;
  table.finish();
  return contact;
}

/// Among the elements that do not lock, the one whose pressures are smooth and whose tets do not collapse. At equal
/// time it has less error than plain tets, except in E_p (docs/speed-against-error).
constexpr ElementType default_element = ElementType::tet4_anp;

void read_element(TableReader table, NumericsParameters& numerics) {
  const std::string type = table.choice_or("type", element_name(default_element), {"tet4", "tet4-anp", "tet4-patch"});
  for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp, ElementType::tet4_patch})
    if (type == element_name(element)) numerics.element = element;
  refuse_foreign_keys(table, {"own_pressure"},
                      numerics.element != ElementType::tet4 ? std::vector<std::string>{"own_pressure"}
                                                            : std::vector<std::string>{},
                      "type = '" + type + "'");
  numerics.own_pressure = table.number_or("own_pressure", usual_own_pressure(numerics.element), Range::between(0, 1));
  const std::string precision = table.choice_or("precision", precision_name(numerics.precision), {"double", "mixed"});
  if (precision == precision_name(Precision::mixed)) numerics.precision = Precision::mixed;
  table.finish();
}

NumericsParameters read_numerics(TableReader table) {
  NumericsParameters numerics;
  numerics.time_step_factor = table.number_or("time_step_factor", numerics.time_step_factor, Range::between(1e-9, 2));
  numerics.step_estimate = table.choice_or("step_estimate", "grain", {"grain", "tet"}) == "grain"
                               ? StepEstimateMethod::grain
                               : StepEstimateMethod::tet;
  numerics.bulk_viscosity_linear =
      table.number_or("bulk_viscosity_linear", numerics.bulk_viscosity_linear, Range::between(0, 1));
  numerics.bulk_viscosity_quadratic =
      table.number_or("bulk_viscosity_quadratic", numerics.bulk_viscosity_quadratic, Range::between(0, 10));
  numerics.mass_scaling = table.number_or("mass_scaling", numerics.mass_scaling, Range::between(1e-12, 1e12));
  if (table.has("mass_scaling_step")) numerics.mass_scaling_step = table.number("mass_scaling_step", positive_time);
  numerics.mass_scaling_lighten = table.boolean_or("mass_scaling_lighten", numerics.mass_scaling_lighten);
  if (numerics.mass_scaling_lighten && numerics.mass_scaling_step == 0)
    table.fail("mass_scaling_lighten", "is used only with 'mass_scaling_step'");
  table.finish();
  return numerics;
}

OutputParameters read_output(TableReader table) {
  OutputParameters output;
  output.history_rows = static_cast<int>(table.integer_or("history_rows", output.history_rows, Range::between(1, 1e6)));
  output.snapshot_relative_densities = table.numbers_or("snapshot_relative_densities", {}, target_density);
  std::sort(output.snapshot_relative_densities.begin(), output.snapshot_relative_densities.end());
  output.checkpoint_relative_densities = table.numbers_or("checkpoint_relative_densities", {}, target_density);
  auto& kept = output.checkpoint_relative_densities;
  std::sort(kept.begin(), kept.end());
  // The density is part of the file's name.
  for (std::size_t i = 1; i < kept.size(); ++i)
    if (kept[i] - kept[i - 1] < smallest_density_step)
      table.fail("checkpoint_relative_densities", fmt::format("found {} and {}, allowed: steps of at least {}",
                                                              kept[i - 1], kept[i], smallest_density_step));
  output.snapshot_at_stage_end = table.boolean_or("snapshot_at_stage_end", output.snapshot_at_stage_end);
  output.checkpoint_interval =
      table.number_or("checkpoint_interval", output.checkpoint_interval, Range::between(1e-9, 1e9));
  table.finish();
  return output;
}

void read_initial(TableReader table, Scenario& scenario) {
  scenario.initial_velocity = table.vector3_or("velocity", {0, 0, 0}, any_speed);
  scenario.grain_velocity = table.vectors3("grain_velocity", any_speed);
  scenario.grain_angular_velocity = table.vectors3("grain_angular_velocity", any_speed);
  table.finish();
}

/// Reads 'walls': true, false, or a table if there are walls. A container takes their place.
void read_walls(TableReader& root, Scenario& scenario) {
  const toml::node* value = root.value("walls");
  if (value == nullptr || !value->is_table()) {
    scenario.walls = root.boolean_or("walls", !scenario.container);
    if (scenario.walls && scenario.container) root.fail("walls", "found true, allowed: false with a [container]");
    return;
  }
  if (scenario.container) root.fail("walls", "cannot be used with a [container], whose tools have their own friction");
  TableReader table = root.table("walls");
  scenario.wall_friction = table.number_or("friction", scenario.wall_friction, friction_or_zero);
  table.finish();
}

void read_gravity(TableReader table, Scenario& scenario) {
  scenario.gravity = table.vector3("acceleration", Range::between(-1e12, 1e12)); // mm/s^2
  table.finish();
}

/// The damaged share of a bond rubs with the stiffness that the bond leaves of the penalty.
void check_friction(const TableReader& contact, const Scenario& scenario) {
  if (!scenario.contact.has_friction() || !scenario.bond) return;
  if (scenario.bond->normal_only) contact.fail("friction", "cannot be used with 'bond.normal_only'");
  if (scenario.bond->stiffness_factor && *scenario.bond->stiffness_factor > scenario.contact.stiffness_factor)
    contact.fail("friction",
                 fmt::format("found bonds stiffer than the penalty (bond.stiffness_factor = {:g}), allowed: "
                             "up to contact.stiffness_factor = {:g}",
                             *scenario.bond->stiffness_factor, scenario.contact.stiffness_factor));
}

/// The same for tools: their adhesion is read before the contact.
void check_adhesion(const Scenario& scenario) {
  for (const ToolParameters& tool : scenario.tools) {
    if (!tool.adhesion || !tool.adhesion->stiffness_factor) continue;
    const double factor = *tool.adhesion->stiffness_factor;
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}tool '{}': adhesion key 'stiffness_factor': {}",
                                   tool.adhesion_places.prefix("stiffness_factor"), tool.name, what));
    };
    if (scenario.contact.stiffness) fail("cannot be used with 'contact.stiffness', allowed: 'stiffness' (MPa/mm)");
    if (tool.friction > 0 && factor > scenario.contact.stiffness_factor)
      fail(fmt::format("found {:g}, allowed: with friction up to contact.stiffness_factor = {:g}", factor,
                       scenario.contact.stiffness_factor));
  }
}

void check_walls(const TableReader& root, const Scenario& scenario) {
  if (scenario.walls) return;
  for (const Stage& stage : scenario.stages)
    if (moves_walls(stage.type))
      root.fail("walls", fmt::format("found false, allowed: true, since stage '{}' moves the walls", stage.name));
}

/// Relative to the scenario's folder, unless absolute.
std::string packing_path(TableReader& root, const std::string& scenario_file) {
  const std::string file = root.string("packing");
  if (file.empty() || file.find('\0') != std::string::npos)
    root.fail("packing", "found an empty or unusable path, allowed: a meshed packing file");
  return (std::filesystem::path(scenario_file).parent_path() / file).lexically_normal().string();
}

} // namespace

Scenario read_scenario(const TomlDocument& document) {
  Scenario scenario;
  TableReader root(document);
  scenario.text = document.text();
  scenario.places = root.places();
  scenario.packing_file = packing_path(root, document.name());
  scenario.tools = read_tools(root, document.name());
  scenario.container = read_container(root, scenario.tools);
  read_walls(root, scenario);
  TableReader material = root.table("material");
  scenario.material = read_material(material);
  material.finish();
  scenario.grain_materials = read_grain_materials(root);
  auto contact = root.optional_table("contact");
  if (contact) scenario.contact = read_contact(*contact, 1 + scenario.grain_materials.size());
  if (auto table = root.optional_table("bond")) {
    scenario.bond_places = table->places();
    scenario.bond = read_bond(*table);
    if (scenario.bond->stiffness_factor && scenario.contact.stiffness)
      table->fail("stiffness_factor", "cannot be used with 'contact.stiffness', allowed: 'stiffness' (MPa/mm)");
  }
  check_adhesion(scenario);
  if (contact) check_friction(*contact, scenario);
  if (auto table = root.optional_table("numerics")) scenario.numerics = read_numerics(*table);
  scenario.numerics.element = default_element;
  scenario.numerics.own_pressure = usual_own_pressure(default_element);
  if (auto table = root.optional_table("element")) read_element(*table, scenario.numerics);
  scenario.output_places = scenario.places;
  if (auto table = root.optional_table("output")) {
    scenario.output_places = table->places();
    scenario.output = read_output(*table);
  }
  if (auto table = root.optional_table("initial")) read_initial(*table, scenario);
  if (auto table = root.optional_table("gravity")) read_gravity(*table, scenario);
  scenario.stages = read_stages(root, {scenario.material.youngs_modulus, scenario.tools, scenario.container});
  check_walls(root, scenario);
  root.finish();
  return scenario;
}

} // namespace mpfem
