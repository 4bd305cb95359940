#include "solver/scenario/scenario.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "common/table_reader.hpp"

namespace mpfem {

namespace {

// Ranges that exclude slips of the decimal point or of units; physics sets its own limits where it has any.
// They also keep finite all that is computed from several of them: squares, ratios, the stable step.
constexpr Range hardening_exponent = Range::between(1e-3, 1);
constexpr Range admissible_poissons_ratio{.low = -1, .high = 0.5, .low_open = true, .high_open = true};
constexpr Range target_density{.low = 0, .high = 1.2, .low_open = true};
constexpr Range positive_density = Range::between(1e-18, 1e3);   // tonne/mm^3
constexpr Range positive_modulus = Range::between(1e-9, 1e12);   // MPa; also strengths and flow stresses
constexpr Range positive_stress = Range::between(1e-12, 1e12);   // MPa
constexpr Range stress_or_zero = Range::between(0, 1e12);        // MPa
constexpr Range any_stress = Range::between(-1e12, 1e12);        // MPa
constexpr Range positive_speed = Range::between(1e-12, 1e12);    // mm/s
constexpr Range any_speed = Range::between(-1e12, 1e12);         // mm/s or rad/s
constexpr Range positive_time = Range::between(1e-15, 1e9);      // s
constexpr Range positive_length = Range::between(1e-12, 1e9);    // mm
constexpr Range any_length = Range::between(-1e9, 1e9);          // mm
constexpr Range rate_or_zero = Range::between(0, 1e15);          // 1/s
constexpr Range positive_stiffness = Range::between(1e-9, 1e18); // MPa/mm
constexpr Range positive_energy = Range::between(1e-18, 1e12);   // N/mm
constexpr Range strain_or_zero = Range::between(0, 1e3);
constexpr double most_grains = 1e9;

constexpr double smallest_density_step = 0.001; // of checkpoints, whose names have three decimals

constexpr std::size_t largest_hardening_table = 64; // TableLaw::max_points

constexpr std::string_view stage_isotropic_compaction = "isotropic_compaction";
constexpr std::string_view stage_isotropic_unloading = "isotropic_unloading";
constexpr std::string_view stage_grip = "grip";
constexpr std::string_view stage_hold = "hold";
constexpr std::string_view stage_unconfined = "unconfined_compression";
constexpr std::string_view stage_triaxial = "triaxial_compression";
constexpr std::string_view stage_die = "die_compression";
constexpr std::string_view stage_probe = "probe";
constexpr std::string_view stage_cycles = "stress_cycles";

/// Refuses keys of `all` that are given but do not belong to the choice made ("law = 'elastic'").
void refuse_foreign_keys(const TableReader& table, const std::vector<std::string>& all,
                         const std::vector<std::string>& meaningful, std::string_view choice) {
  for (const std::string& key : all)
    if (table.has(key) && std::find(meaningful.begin(), meaningful.end(), key) == meaningful.end())
      table.fail(key, fmt::format("has no meaning with {}", choice));
}

HardeningLaw hardening_law(const std::string& name) {
  if (name == "elastic") return HardeningLaw::elastic;
  if (name == "power") return HardeningLaw::power;
  if (name == "total_strain") return HardeningLaw::total_strain;
  return HardeningLaw::table;
}

std::vector<std::string> hardening_keys(HardeningLaw law) {
  switch (law) {
  case HardeningLaw::elastic:
    return {};
  case HardeningLaw::power:
    return {"yield_stress", "coefficient", "exponent"};
  case HardeningLaw::total_strain:
    return {"coefficient", "exponent"};
  case HardeningLaw::table:
    return {"plastic_strain", "flow_stress"};
  }
  return {};
}

void check_hardening_table(const TableReader& table, const HardeningParameters& hardening, double shear_modulus) {
  const auto& strain = hardening.table_plastic_strain;
  const auto& stress = hardening.table_flow_stress;
  if (strain.empty()) table.fail("plastic_strain", "found an empty array, expected at least one value");
  if (strain.size() > largest_hardening_table)
    table.fail("plastic_strain",
               fmt::format("found {} values, allowed 1 … {}", strain.size(), largest_hardening_table));
  if (stress.size() != strain.size())
    table.fail("flow_stress",
               fmt::format("found {} values, expected {}, as many as plastic_strain", stress.size(), strain.size()));
  if (strain[0] != 0) table.fail("plastic_strain", fmt::format("found first value {}, allowed 0", strain[0]));
  for (std::size_t i = 1; i < strain.size(); ++i) {
    if (!(strain[i] > strain[i - 1]))
      table.fail("plastic_strain",
                 fmt::format("found {} after {}, allowed increasing values", strain[i], strain[i - 1]));
    const double slope = (stress[i] - stress[i - 1]) / (strain[i] - strain[i - 1]);
    // A steeper fall has no unique answer to a strain increment.
    if (!(slope > -3 * shear_modulus))
      table.fail("flow_stress", fmt::format("found a slope of {} MPa between values {} and {}, allowed > -3 G = {}",
                                            slope, i - 1, i, -3 * shear_modulus));
  }
}

HardeningParameters read_hardening(TableReader table, double youngs_modulus, double poissons_ratio) {
  HardeningParameters hardening;
  const std::string law = table.choice("law", {"elastic", "power", "total_strain", "table"});
  hardening.law = hardening_law(law);
  refuse_foreign_keys(table, {"yield_stress", "coefficient", "exponent", "plastic_strain", "flow_stress"},
                      hardening_keys(hardening.law), fmt::format("law = '{}'", law));
  switch (hardening.law) {
  case HardeningLaw::elastic:
    break;
  case HardeningLaw::power:
    hardening.yield_stress = table.number("yield_stress", positive_modulus);
    hardening.coefficient = table.number("coefficient", positive_modulus);
    hardening.exponent = table.number("exponent", hardening_exponent);
    break;
  case HardeningLaw::total_strain:
    hardening.coefficient = table.number("coefficient", {.low = 1e-9, .high = youngs_modulus, .high_open = true});
    hardening.exponent = table.number("exponent", Range::between(1e-3, 0.99));
    break;
  case HardeningLaw::table:
    hardening.table_plastic_strain = table.numbers("plastic_strain", strain_or_zero);
    hardening.table_flow_stress = table.numbers("flow_stress", positive_modulus);
    check_hardening_table(table, hardening, youngs_modulus / (2 * (1 + poissons_ratio)));
    break;
  }
  table.finish();
  return hardening;
}

/// Without table.finish(): the table may hold more.
MaterialParameters read_material(TableReader& table) {
  MaterialParameters material;
  material.density = table.number("density", positive_density);
  material.youngs_modulus = table.number("youngs_modulus", positive_modulus);
  material.poissons_ratio = table.number("poissons_ratio", admissible_poissons_ratio);
  material.hardening = read_hardening(table.table("hardening"), material.youngs_modulus, material.poissons_ratio);
  return material;
}

std::vector<GrainMaterial> read_grain_materials(TableReader& root) {
  std::vector<GrainMaterial> materials;
  std::set<std::int64_t> seen;
  for (TableReader& table : root.tables("grain_material")) {
    GrainMaterial other;
    for (const std::int64_t grain : table.integers("grains", Range::between(0, most_grains))) {
      if (!seen.insert(grain).second)
        table.fail("grains", fmt::format("found {} twice, allowed one material a grain", grain));
      other.grains.push_back(grain);
    }
    if (other.grains.empty()) table.fail("grains", "found no grain, expected at least one");
    other.material = read_material(table);
    table.finish();
    materials.push_back(std::move(other));
  }
  return materials;
}

ContactParameters read_contact(TableReader table) {
  ContactParameters contact;
  contact.stiffness_factor = table.number_or("stiffness_factor", contact.stiffness_factor, Range::between(1e-6, 1e4));
  if (table.has("stiffness")) {
    if (table.has("stiffness_factor")) table.fail("stiffness", "has no meaning with 'stiffness_factor'");
    contact.stiffness = table.number("stiffness", positive_stiffness);
  }
  contact.search_margin = table.number_or("search_margin", contact.search_margin, Range::between(0.05, 2));
  const std::string surface = table.choice_or("surface", "automatic", {"automatic", "facets", "smooth"});
  contact.surface = surface == "smooth"   ? ContactSurface::smooth
                    : surface == "facets" ? ContactSurface::facets
                                          : ContactSurface::automatic;
  table.finish();
  return contact;
}

/// Of the elements that do not lock the one whose pressures are smooth and whose tets do not collapse; less error at equal time
/// than plain tets but for E_p (docs/speed-against-error).
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
  numerics.step_estimate =
      table.choice_or("step_estimate", "grain", {"grain", "tet"}) == "grain" ? StepEstimate::grain : StepEstimate::tet;
  numerics.bulk_viscosity_linear =
      table.number_or("bulk_viscosity_linear", numerics.bulk_viscosity_linear, Range::between(0, 1));
  numerics.bulk_viscosity_quadratic =
      table.number_or("bulk_viscosity_quadratic", numerics.bulk_viscosity_quadratic, Range::between(0, 10));
  numerics.mass_scaling = table.number_or("mass_scaling", numerics.mass_scaling, Range::between(1e-12, 1e12));
  if (table.has("mass_scaling_step")) numerics.mass_scaling_step = table.number("mass_scaling_step", positive_time);
  numerics.mass_scaling_lighten = table.boolean_or("mass_scaling_lighten", numerics.mass_scaling_lighten);
  if (numerics.mass_scaling_lighten && numerics.mass_scaling_step == 0)
    table.fail("mass_scaling_lighten", "has no meaning without 'mass_scaling_step'");
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
  // The density stands in the file's name.
  for (std::size_t i = 1; i < kept.size(); ++i)
    if (kept[i] - kept[i - 1] < smallest_density_step)
      table.fail("checkpoint_relative_densities", fmt::format("found {} and {}, expected steps of at least {}",
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

DampingParameters read_damping(TableReader& table) {
  DampingParameters damping;
  damping.rate = table.number_or("damping_rate", 0, rate_or_zero);
  if (table.has("damping_fade_stress") && !table.has("damping_rate"))
    table.fail("damping_fade_stress", "has no meaning without 'damping_rate'");
  const auto fade_stress = table.optional_number("damping_fade_stress", positive_stress);
  if (damping.rate > 0 && !fade_stress)
    table.fail("damping_fade_stress", "missing, expected a number > 0, since damping_rate > 0");
  damping.fade_stress = fade_stress.value_or(0);
  return damping;
}

/// `speed`: mm/s, the stage's own; `youngs_modulus`: MPa, of the grains.
std::optional<QuasiStatic> read_quasi_static(TableReader& stage, double speed, double youngs_modulus) {
  constexpr double slower = 0.25, faster = 4; // bounds where none are given, over the stage's own speed
  constexpr double loose = 1e-3;              // stress of a loose packing over the grains' modulus
  constexpr Range part = Range::between(1e-9, 1);
  std::optional<TableReader> table = stage.optional_table("quasi_static");
  if (!table) return std::nullopt;
  if (!(speed > 0)) stage.fail("quasi_static", "has no meaning where nothing moves");
  if (stage.has("duration"))
    stage.fail("duration", "has no meaning with quasi_static, which stretches the stage's time");
  QuasiStatic q;
  q.kinetic_tolerance = table->number_or("kinetic_tolerance", q.kinetic_tolerance, part);
  q.stress_tolerance = table->number_or("stress_tolerance", q.stress_tolerance, part);
  q.slowest_speed = table->number_or("slowest_speed", slower * speed, {.low = 1e-13, .high = speed});
  q.fastest_speed = table->number_or("fastest_speed", faster * speed, {.low = speed, .high = 1e13});
  q.loose_stress = table->number_or("loose_stress", loose * youngs_modulus, stress_or_zero);
  table->finish();
  return q;
}

/// The name stands in file names, so it is a plain word.
void check_stage_name(const TableReader& table, const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  constexpr std::size_t longest = 64;
  if (name.empty() || name.size() > longest || !plain)
    table.fail("name", fmt::format("found '{}', allowed 1 … {} letters (a … z), digits, '-' and '_'",
                                   name.size() > longest ? "a longer text" : name, longest));
}

/// Keys of each type of stage, besides those that all have.
const std::vector<std::pair<std::string, std::vector<std::string>>> stage_keys = {
    {std::string(stage_isotropic_compaction), {"relative_density", "mean_stress", "wall_speed", "ramp_fraction"}},
    {std::string(stage_isotropic_unloading), {"mean_stress", "wall_speed", "ramp_fraction"}},
    {std::string(stage_grip), {"axis", "grip_depth", "lateral", "displacement", "sliding", "speed", "ramp_fraction"}},
    {std::string(stage_hold), {"duration", "mean_stress", "servo_speed"}},
    {std::string(stage_unconfined),
     {"wall_speed", "ramp_fraction", "axial_strain", "axial_stress", "stress_drop", "dissipation_ratio", "duration"}},
    {std::string(stage_triaxial),
     {"wall_speed", "servo_speed", "ramp_fraction", "hold", "lateral_stress", "axial_strain", "axial_stress",
      "deviatoric_stress", "stress_drop", "dissipation_ratio", "duration"}},
    {std::string(stage_die),
     {"wall_speed", "ramp_fraction", "axial_strain", "relative_density", "axial_stress", "dissipation_ratio",
      "duration"}},
    {std::string(stage_probe),
     {"wall_speed", "servo_speed", "ramp_fraction", "direction", "axial_strain", "mean_stress", "deviatoric_stress",
      "dissipation_ratio", "duration"}},
    {std::string(stage_cycles), {"wall_speed", "ramp_fraction", "lowest_mean_stress", "highest_mean_stress", "cycles"}},
};

/// The keys that end a loading, of those that the stage's type allows.
LoadingEnds read_ends(TableReader& table, std::string_view type) {
  constexpr Range strain{.low = -0.5, .high = 0.5}; // beyond, walls that were never to come so far are a slip
  LoadingEnds ends;
  ends.axial_strain = table.optional_number("axial_strain", strain);
  if (ends.axial_strain == 0.0) table.fail("axial_strain", "found 0, allowed > 0 (compression) or < 0 (extension)");
  ends.relative_density = table.optional_number("relative_density", target_density);
  ends.axial_stress = table.optional_number("axial_stress", stress_or_zero);
  ends.mean_stress = table.optional_number("mean_stress", stress_or_zero);
  ends.deviatoric_stress = table.optional_number("deviatoric_stress", any_stress);
  ends.stress_drop = table.optional_number("stress_drop", {.low = 0, .high = 1, .low_open = true, .high_open = true});
  ends.dissipation_ratio = table.optional_number("dissipation_ratio", {.low = 1, .high = 1e9, .low_open = true});
  ends.duration = table.optional_number("duration", positive_time);
  if (!ends.axial_strain && !ends.relative_density && !ends.axial_stress && !ends.mean_stress &&
      !ends.deviatoric_stress && !ends.stress_drop && !ends.dissipation_ratio && !ends.duration)
    table.fail("type", fmt::format("found '{}' without an end, expected at least one of axial_strain, "
                                   "dissipation_ratio, duration and the other ends of that type",
                                   type));
  return ends;
}

std::array<double, 2> read_direction(TableReader& table) {
  const std::vector<double> direction = table.numbers("direction", Range::between(-1e12, 1e12));
  if (direction.size() != 2 || (direction[0] == 0 && direction[1] == 0))
    table.fail("direction", "expected two numbers, [dp, dq], not both 0");
  return {direction[0], direction[1]};
}

WallLoading read_loading(TableReader& table, std::string_view type) {
  WallLoading loading;
  loading.wall_speed = table.number("wall_speed", positive_speed);
  loading.ramp_fraction = table.number_or("ramp_fraction", loading.ramp_fraction, Range::between(0, 0.5));
  if (type == stage_isotropic_compaction) {
    loading.path = LoadingPath::isotropic;
    loading.ends.mean_stress = table.number("mean_stress", positive_stress);
  } else if (type == stage_cycles) {
    loading.path = LoadingPath::cycles;
    loading.highest_mean_stress = table.number("highest_mean_stress", positive_stress);
    loading.lowest_mean_stress =
        table.number("lowest_mean_stress", {.low = 0, .high = loading.highest_mean_stress, .high_open = true});
    loading.cycles = table.integer("cycles", Range::between(1, 1e4));
  } else {
    // A packing that dilates moves its lateral walls faster than its axial ones; one that bursts under little stress, many times.
    constexpr double servo_speed = 10;
    loading.servo_speed =
        table.number_or("servo_speed", servo_speed * loading.wall_speed, {.low = 1e-12, .high = 1e13});
    loading.path = type == stage_unconfined ? LoadingPath::unconfined
                   : type == stage_triaxial ? LoadingPath::triaxial
                   : type == stage_die      ? LoadingPath::die
                                            : LoadingPath::probe;
    if (type == stage_triaxial) {
      loading.hold_force = table.choice_or("hold", "force", {"force", "stress"}) == "force";
      loading.lateral_stress = table.optional_number("lateral_stress", positive_stress);
    }
    if (type == stage_probe) loading.direction = read_direction(table);
    loading.ends = read_ends(table, type);
  }
  return loading;
}

GripMotion read_grip(TableReader& table) {
  GripMotion grip;
  const std::string axis = table.choice_or("axis", "z", {"x", "y", "z"});
  grip.axis = axis[0] - 'x';
  grip.depth = table.number("grip_depth", positive_length);
  grip.lateral_fixed = table.choice_or("lateral", "fixed", {"fixed", "free"}) == "fixed";
  grip.displacement = table.number_or("displacement", 0, any_length);
  grip.sliding = table.vector3_or("sliding", {0, 0, 0}, any_length);
  const bool slides = grip.sliding != std::array<double, 3>{};
  if (slides && !grip.lateral_fixed) table.fail("sliding", "has no meaning with lateral = 'free'");
  if (grip.sliding[static_cast<std::size_t>(grip.axis)] != 0)
    table.fail("sliding", fmt::format("found a part along the axis {}, allowed only across it", axis));
  if (grip.displacement == 0 && !slides)
    table.fail("displacement", "missing or 0, expected a number < 0 (together) or > 0 (apart), or 'sliding'");
  grip.speed = table.number("speed", positive_speed);
  grip.ramp_fraction = table.number_or("ramp_fraction", grip.ramp_fraction, Range::between(0, 0.5));
  return grip;
}

Stage read_stage(TableReader table, std::size_t number, double youngs_modulus) {
  Stage stage;
  std::vector<std::string> types, all_keys;
  for (const auto& [name, keys] : stage_keys) {
    types.push_back(name);
    all_keys.insert(all_keys.end(), keys.begin(), keys.end());
  }
  const std::string type = table.choice("type", types);
  stage.name = table.string_or("name", fmt::format("{}-{}", type, number));
  check_stage_name(table, stage.name);
  for (const auto& [name, keys] : stage_keys)
    if (name == type) refuse_foreign_keys(table, all_keys, keys, fmt::format("type = '{}'", type));

  if (type == stage_isotropic_compaction && table.has("mean_stress")) {
    if (table.has("relative_density")) table.fail("mean_stress", "has no meaning with 'relative_density'");
    stage.loading = read_loading(table, type);
  } else if (type == stage_isotropic_compaction) {
    IsotropicCompaction compaction;
    compaction.relative_density = table.number("relative_density", target_density);
    compaction.wall_speed = table.number("wall_speed", positive_speed);
    compaction.ramp_fraction = table.number_or("ramp_fraction", compaction.ramp_fraction, Range::between(0, 0.5));
    stage.isotropic_compaction = compaction;
  } else if (type == stage_isotropic_unloading) {
    IsotropicUnloading unloading;
    unloading.mean_stress = table.number("mean_stress", stress_or_zero);
    unloading.wall_speed = table.number("wall_speed", positive_speed);
    unloading.ramp_fraction = table.number_or("ramp_fraction", unloading.ramp_fraction, Range::between(0, 0.5));
    stage.isotropic_unloading = unloading;
  } else if (type == stage_grip) {
    stage.grip = read_grip(table);
  } else if (type == stage_hold) {
    const double duration = table.number("duration", positive_time);
    if (const auto stress = table.optional_number("mean_stress", positive_stress)) {
      constexpr double usual_servo_speed = 2000; // mm/s, far above what a packing at rest asks for
      WallLoading loading;
      loading.path = LoadingPath::held;
      loading.held_stress = *stress;
      loading.servo_speed = table.number_or("servo_speed", usual_servo_speed, positive_speed);
      loading.ends.duration = duration;
      stage.loading = loading;
    } else {
      if (table.has("servo_speed")) table.fail("servo_speed", "has no meaning without 'mean_stress'");
      stage.hold = Hold{.duration = duration};
    }
  } else {
    stage.loading = read_loading(table, type);
  }
  stage.quasi_static = read_quasi_static(table, stage.speed(), youngs_modulus);
  stage.damping = read_damping(table);
  stage.places = table.places();
  table.finish();
  return stage;
}

std::vector<Stage> read_stages(TableReader& root, double youngs_modulus) {
  std::vector<TableReader> tables = root.tables("stages");
  if (tables.empty())
    root.fail("stages", root.has("stages") ? "found no stage, expected at least one [[stages]]"
                                           : "missing, expected at least one [[stages]]");
  std::vector<Stage> stages;
  std::set<std::string> names;
  for (TableReader& table : tables) {
    stages.push_back(read_stage(table, stages.size() + 1, youngs_modulus));
    const std::string& name = stages.back().name;
    if (!names.insert(name).second)
      table.fail("name", fmt::format("found '{}', which an earlier stage has, expected different names", name));
  }
  return stages;
}

void check_walls(const TableReader& root, const Scenario& scenario) {
  if (scenario.walls) return;
  for (const Stage& stage : scenario.stages)
    if (stage.isotropic_compaction || stage.isotropic_unloading || stage.loading)
      root.fail("walls", fmt::format("found false, expected true, since stage '{}' moves the walls", stage.name));
}

/// Relative to the scenario's folder, unless absolute.
std::string packing_path(TableReader& root, const std::string& scenario_file) {
  const std::string file = root.string("packing");
  if (file.empty() || file.find('\0') != std::string::npos)
    root.fail("packing", "found an empty or unusable path, expected a meshed packing file");
  return (std::filesystem::path(scenario_file).parent_path() / file).lexically_normal().string();
}

} // namespace

double usual_own_pressure(ElementType element) {
  // So little keeps the tets of a patch from collapsing into each other (docs/numerics.md).
  return element == ElementType::tet4_patch ? 0.03 : 0.0;
}

const char* element_name(ElementType element) {
  switch (element) {
  case ElementType::tet4:
    return "tet4";
  case ElementType::tet4_anp:
    return "tet4-anp";
  case ElementType::tet4_patch:
    return "tet4-patch";
  }
  return "";
}

const char* precision_name(Precision precision) {
  return precision == Precision::mixed ? "mixed" : "double";
}

BondParameters read_bond(TableReader table) {
  BondParameters bond;
  bond.tensile_strength = table.number("tensile_strength", positive_modulus);
  bond.shear_strength = table.number("shear_strength", positive_modulus);
  bond.fracture_energy = table.number("fracture_energy", positive_energy);
  if (table.choice_or("softening", "exponential", {"exponential", "energy"}) == "energy")
    bond.softening = SofteningLaw::energy;
  bond.rebond_on_contact = table.choice_or("rebond", "never", {"never", "on_contact"}) == "on_contact";
  bond.normal_only = table.boolean_or("normal_only", bond.normal_only);
  table.finish();
  return bond;
}

Scenario read_scenario(const TomlDocument& document) {
  Scenario scenario;
  TableReader root(document);
  scenario.text = document.text();
  scenario.packing_file = packing_path(root, document.name());
  scenario.walls = root.boolean_or("walls", true);
  TableReader material = root.table("material");
  scenario.material = read_material(material);
  material.finish();
  scenario.grain_materials = read_grain_materials(root);
  if (auto table = root.optional_table("contact")) scenario.contact = read_contact(*table);
  if (auto table = root.optional_table("bond")) {
    scenario.bond_places = table->places();
    scenario.bond = read_bond(*table);
  }
  if (auto table = root.optional_table("numerics")) scenario.numerics = read_numerics(*table);
  scenario.numerics.element = default_element;
  scenario.numerics.own_pressure = usual_own_pressure(default_element);
  if (auto table = root.optional_table("element")) read_element(*table, scenario.numerics);
  if (auto table = root.optional_table("output")) scenario.output = read_output(*table);
  if (auto table = root.optional_table("initial")) read_initial(*table, scenario);
  scenario.stages = read_stages(root, scenario.material.youngs_modulus);
  check_walls(root, scenario);
  root.finish();
  return scenario;
}

} // namespace mpfem
