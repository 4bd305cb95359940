#include "solver/scenario/read_stages.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "solver/scenario/common_keys.hpp"
#include "solver/scenario/ranges.hpp"
#include "solver/scenario/read_tools.hpp"

namespace mpfem {

namespace {

double read_wall_speed(TableReader& table) {
  return table.number("wall_speed", positive_speed);
}

double read_ramp_fraction(TableReader& table) {
  constexpr double usual = 0.1;
  return table.number_or("ramp_fraction", usual, Range::between(0, 0.5));
}

/// Servo speed (mm/s) of walls that are held while others are driven at `wall_speed` (mm/s).
double read_servo_speed(TableReader& table, double wall_speed) {
  // A packing that dilates moves its lateral walls faster than its axial ones. One that fails suddenly under little
  // stress moves them many times as fast.
  constexpr double usual = 10;
  return table.number_or("servo_speed", usual * wall_speed, {.low = 1e-12, .high = 1e13});
}

/// Reads the keys that end a loading; the stage's type may allow only some of them.
LoadingEnds read_ends(TableReader& table, std::string_view type) {
  constexpr Range strain{.low = -0.5, .high = 0.5}; // a larger one is a typing error
  LoadingEnds ends;
  ends.axial_strain = table.optional_number("axial_strain", strain);
  constexpr double smallest_strain = 1e-6; // a thousand times the tolerance with which walls arrive
  if (ends.axial_strain && std::abs(*ends.axial_strain) < smallest_strain)
    table.fail("axial_strain", fmt::format("found {:g}, allowed: at least {:g} (compression) or at most -{:g} "
                                           "(extension)",
                                           *ends.axial_strain, smallest_strain, smallest_strain));
  ends.relative_density = table.optional_number("relative_density", target_density);
  ends.axial_stress = table.optional_number("axial_stress", stress_or_zero);
  ends.mean_stress = table.optional_number("mean_stress", stress_or_zero);
  ends.deviatoric_stress = table.optional_number("deviatoric_stress", any_stress);
  ends.stress_drop = table.optional_number("stress_drop", {.low = 0, .high = 1, .low_open = true, .high_open = true});
  ends.dissipation_ratio = table.optional_number("dissipation_ratio", {.low = 1, .high = 1e9, .low_open = true});
  ends.duration = table.optional_number("duration", positive_time);
  if (!ends.axial_strain && !ends.relative_density && !ends.axial_stress && !ends.mean_stress &&
      !ends.deviatoric_stress && !ends.stress_drop && !ends.dissipation_ratio && !ends.duration)
    table.fail("type", fmt::format("found '{}' without an end, allowed: at least one of axial_strain, "
                                   "dissipation_ratio, duration and the other ends of that type",
                                   type));
  return ends;
}

StageType read_isotropic_compaction(TableReader& table) {
  if (table.has("mean_stress")) {
    if (table.has("relative_density")) table.fail("mean_stress", "cannot be used with 'relative_density'");
    return IsotropicLoading{.mean_stress = table.number("mean_stress", positive_stress),
                            .wall_speed = read_wall_speed(table),
                            .ramp_fraction = read_ramp_fraction(table)};
  }
  if (!table.has("relative_density"))
    table.fail("type", "found 'isotropic_compaction' without an end, allowed: with relative_density or mean_stress");
  return IsotropicCompaction{.relative_density = table.number("relative_density", target_density),
                             .wall_speed = read_wall_speed(table),
                             .ramp_fraction = read_ramp_fraction(table)};
}

StageType read_isotropic_unloading(TableReader& table) {
  return IsotropicUnloading{.mean_stress = table.number("mean_stress", stress_or_zero),
                            .wall_speed = read_wall_speed(table),
                            .ramp_fraction = read_ramp_fraction(table)};
}

StageType read_stress_cycles(TableReader& table) {
  const double highest = table.number("highest_mean_stress", positive_stress);
  return StressCycles{.lowest_mean_stress =
                          table.number("lowest_mean_stress", {.low = 0, .high = highest, .high_open = true}),
                      .highest_mean_stress = highest,
                      .cycles = table.integer("cycles", Range::between(1, 1e4)),
                      .wall_speed = read_wall_speed(table),
                      .ramp_fraction = read_ramp_fraction(table)};
}

AxialDrive read_axial_drive(TableReader& table, std::string_view type) {
  return {
      .wall_speed = read_wall_speed(table), .ramp_fraction = read_ramp_fraction(table), .ends = read_ends(table, type)};
}

StageType read_unconfined(TableReader& table) {
  return UnconfinedCompression{read_axial_drive(table, "unconfined_compression")};
}

StageType read_die(TableReader& table) {
  return DieCompression{read_axial_drive(table, "die_compression")};
}

StageType read_triaxial(TableReader& table) {
  TriaxialCompression triaxial{read_axial_drive(table, "triaxial_compression")};
  triaxial.servo_speed = read_servo_speed(table, triaxial.wall_speed);
  triaxial.hold_force = table.choice_or("hold", "force", {"force", "stress"}) == "force";
  triaxial.lateral_stress = table.optional_number("lateral_stress", positive_stress);
  return triaxial;
}

StageType read_probe(TableReader& table) {
  StressProbe probe;
  probe.wall_speed = read_wall_speed(table);
  probe.ramp_fraction = read_ramp_fraction(table);
  probe.servo_speed = read_servo_speed(table, probe.wall_speed);
  const std::vector<double> direction = table.numbers("direction", Range::between(-1e12, 1e12));
  if (direction.size() != 2 || (direction[0] == 0 && direction[1] == 0))
    table.fail("direction", "allowed: two numbers, [dp, dq], not both 0");
  probe.direction = {direction[0], direction[1]};
  probe.ends = read_ends(table, "probe");
  const auto [dp, dq] = probe.direction;
  const auto refuse = [&](const char* key, const char* component) {
    table.fail(key, fmt::format("cannot end a probe with {} = 0 in 'direction', allowed: other ends", component));
  };
  if (probe.ends.mean_stress && dp == 0) refuse("mean_stress", "dp");
  if (probe.ends.deviatoric_stress && dq == 0) refuse("deviatoric_stress", "dq");
  return probe;
}

StageType read_hold(TableReader& table) {
  const double duration = table.number("duration", positive_time);
  if (const auto stress = table.optional_number("mean_stress", positive_stress)) {
    constexpr double usual_servo_speed = 2000; // mm/s, far above what a packing at rest needs
    return HeldStress{.mean_stress = *stress,
                      .duration = duration,
                      .servo_speed = table.number_or("servo_speed", usual_servo_speed, positive_speed)};
  }
  if (table.has("servo_speed")) table.fail("servo_speed", "is used only with 'mean_stress'");
  return Rest{.duration = duration};
}

StageType read_grip(TableReader& table) {
  GripMotion grip;
  grip.axis = read_axis(table);
  grip.depth = table.number("grip_depth", positive_length);
  grip.lateral_fixed = table.choice_or("lateral", "fixed", {"fixed", "free"}) == "fixed";
  grip.displacement = table.number_or("displacement", 0, any_length);
  grip.sliding = table.vector3_or("sliding", {0, 0, 0}, any_length);
  const bool slides = grip.sliding != std::array<double, 3>{};
  if (slides && !grip.lateral_fixed) table.fail("sliding", "cannot be used with lateral = 'free'");
  if (grip.sliding[grip.axis] != 0)
    table.fail("sliding",
               fmt::format("found a component along the axis {}, allowed: across it only", "xyz"[grip.axis]));
  if (grip.displacement == 0 && !slides)
    table.fail("displacement", "missing or 0, allowed: a number < 0 (together) or > 0 (apart), or 'sliding'");
  grip.speed = table.number("speed", positive_speed);
  grip.ramp_fraction = read_ramp_fraction(table);
  return grip;
}

/// The direction along which the push of a watched tool is taken: that in which the stage drives it, or its own.
std::array<double, 3> read_watched_direction(TableReader& table, const StageContext& context, std::size_t watched,
                                             std::span<const ToolDrive> drives) {
  const auto drive = std::find_if(drives.begin(), drives.end(), [&](const ToolDrive& d) { return d.tool == watched; });
  if (drive != drives.end() && drive->direction != std::array<double, 3>{}) return drive->direction;
  const auto direction = direction_of(context.tools[watched].shape);
  if (!direction)
    table.fail("watch", "found a sphere or an STL surface, which has no direction, allowed: another tool, or one that "
                        "the stage drives with a 'direction'");
  return *direction;
}

bool is_away(const ToolLoading& loading, std::size_t tool) {
  return std::find(loading.away.begin(), loading.away.end(), tool) != loading.away.end();
}

/// `loading`: with the drives and withdrawn tools of the stage.
ToolEnds read_tool_ends(TableReader& table, const StageContext& context, const ToolLoading& loading) {
  ToolEnds ends;
  ends.relative_density = table.optional_number("relative_density", target_density);
  ends.height = table.optional_number("height", positive_length);
  ends.axial_stress = table.optional_number("axial_stress", stress_or_zero);
  ends.travel = table.optional_number("travel", positive_length);
  ends.force = table.optional_number("force", stress_or_zero);
  ends.force_drop = table.optional_number("force_drop", {.low = 0, .high = 1, .low_open = true, .high_open = true});
  ends.forces_reached = table.boolean_or("forces_reached", false);
  ends.duration = table.optional_number("duration", positive_time);
  if (!ends.relative_density && !ends.height && !ends.axial_stress && !ends.travel && !ends.force && !ends.force_drop &&
      !ends.forces_reached && !ends.duration)
    table.fail("type", "found 'tools' without an end, allowed: at least one of relative_density, height, axial_stress, "
                       "travel, force, force_drop, forces_reached and duration");
  if (ends.forces_reached && std::ranges::none_of(loading.drives, &ToolDrive::holds_push))
    table.fail("forces_reached", "found no tool that holds a force or stress, allowed: with one");
  if (ends.height && ends.relative_density)
    table.fail("height", "found together with 'relative_density', allowed: one of the two; each determines the other");
  for (const char* key : {"relative_density", "height", "axial_stress"})
    if (table.has(key) && !context.container) table.fail(key, "is used only with a [container]");
  if (table.has("smallest_peak") && !ends.force_drop) table.fail("smallest_peak", "is used only with 'force_drop'");
  ends.smallest_peak = table.number_or("smallest_peak", 0, stress_or_zero);
  const bool watches = ends.force || ends.force_drop;
  if (!watches && table.has("watch")) table.fail("watch", "is used only with 'force' or 'force_drop'");
  if (!watches) return ends;
  ends.watched = tool_named(table, "watch", table.string("watch"), context.tools);
  if (is_away(loading, ends.watched))
    table.fail("watch", fmt::format("found '{}', which is away in this stage, allowed: a tool that is in place",
                                    context.tools[ends.watched].name));
  ends.watched_direction = read_watched_direction(table, context, ends.watched, loading.drives);
  return ends;
}

StageType read_tool_loading(TableReader& table, const StageContext& context) {
  ToolLoading loading;
  loading.container = context.container;
  loading.drives = read_drives(table, context.tools, context.container);
  for (const std::string& name : table.strings_or("away", {}))
    loading.away.push_back(tool_named(table, "away", name, context.tools));
  for (const ToolDrive& drive : loading.drives) {
    if (is_away(loading, drive.tool))
      table.fail("away", fmt::format("found '{}', which the stage also drives, allowed: a tool that it does not drive",
                                     context.tools[drive.tool].name));
    const auto& v = drive.velocity;
    loading.speed = std::max(loading.speed, std::hypot(v[0], v[1], v[2]));
    loading.servo_speed = std::max(loading.servo_speed, drive.servo_speed);
  }
  loading.ramp_fraction = read_ramp_fraction(table);
  loading.ends = read_tool_ends(table, context, loading);
  if (loading.speed == 0 && loading.ends.travel)
    table.fail("travel", "is used only if a tool is driven at a speed or velocity");
  if (loading.speed == 0 && loading.servo_speed == 0 && !loading.ends.duration)
    table.fail("duration", "missing, allowed: the time of a stage in which no tool moves");
  return loading;
}

/// A type of stage as scenarios name it.
struct StageKeyword {
  std::string name;
  std::vector<std::string> keys; ///< besides those that all stages have
  std::function<StageType(TableReader&, const StageContext&)> read;
};

/// The reader of a type that needs nothing else from the scenario.
auto alone(StageType (*read)(TableReader&)) {
  return [read](TableReader& table, const StageContext& /*context*/) { return read(table); };
}

const std::vector<StageKeyword>& stage_keywords() {
  static const std::vector<StageKeyword> keywords = {
      {"isotropic_compaction",
       {"relative_density", "mean_stress", "wall_speed", "ramp_fraction"},
       alone(read_isotropic_compaction)},
      {"isotropic_unloading", {"mean_stress", "wall_speed", "ramp_fraction"}, alone(read_isotropic_unloading)},
      {"grip",
       {"axis", "grip_depth", "lateral", "displacement", "sliding", "speed", "ramp_fraction"},
       alone(read_grip)},
      {"hold", {"duration", "mean_stress", "servo_speed"}, alone(read_hold)},
      {"unconfined_compression",
       {"wall_speed", "ramp_fraction", "axial_strain", "axial_stress", "stress_drop", "dissipation_ratio", "duration"},
       alone(read_unconfined)},
      {"triaxial_compression",
       {"wall_speed", "servo_speed", "ramp_fraction", "hold", "lateral_stress", "axial_strain", "axial_stress",
        "deviatoric_stress", "stress_drop", "dissipation_ratio", "duration"},
       alone(read_triaxial)},
      {"die_compression",
       {"wall_speed", "ramp_fraction", "axial_strain", "relative_density", "axial_stress", "dissipation_ratio",
        "duration"},
       alone(read_die)},
      {"probe",
       {"wall_speed", "servo_speed", "ramp_fraction", "direction", "axial_strain", "mean_stress", "deviatoric_stress",
        "dissipation_ratio", "duration"},
       alone(read_probe)},
      {"stress_cycles",
       {"wall_speed", "ramp_fraction", "lowest_mean_stress", "highest_mean_stress", "cycles"},
       alone(read_stress_cycles)},
      {"tools",
       {"drive", "away", "ramp_fraction", "relative_density", "height", "axial_stress", "travel", "force", "force_drop",
        "smallest_peak", "watch", "forces_reached", "duration"},
       read_tool_loading},
  };
  return keywords;
}

DampingParameters read_damping(TableReader& table) {
  DampingParameters damping;
  damping.rate = table.number_or("damping_rate", 0, rate_or_zero);
  if (table.has("damping_fade_stress") && !table.has("damping_rate"))
    table.fail("damping_fade_stress", "is used only with 'damping_rate'");
  const auto fade_stress = table.optional_number("damping_fade_stress", positive_stress);
  if (damping.rate > 0 && !fade_stress)
    table.fail("damping_fade_stress", "missing, allowed: a number > 0, since damping_rate > 0");
  damping.fade_stress = fade_stress.value_or(0);
  return damping;
}

/// `speed`: mm/s, the stage's own; `youngs_modulus`: MPa, of the grains.
std::optional<QuasiStatic> read_quasi_static(TableReader& stage, double speed, double youngs_modulus) {
  constexpr double slower = 0.25, faster = 4; // default bounds, over the stage's own speed
  constexpr double loose = 1e-3;              // stress of a loose packing over the grains' modulus
  constexpr Range part = Range::between(1e-9, 1);
  std::optional<TableReader> table = stage.optional_table("quasi_static");
  if (!table) return std::nullopt;
  if (!(speed > 0)) stage.fail("quasi_static", "is used only where something moves");
  if (stage.has("duration"))
    stage.fail("duration", "cannot be used with quasi_static, which stretches the stage's time");
  QuasiStatic q;
  q.kinetic_tolerance = table->number_or("kinetic_tolerance", q.kinetic_tolerance, part);
  q.stress_tolerance = table->number_or("stress_tolerance", q.stress_tolerance, part);
  q.slowest_speed = table->number_or("slowest_speed", slower * speed, {.low = 1e-13, .high = speed});
  q.fastest_speed = table->number_or("fastest_speed", faster * speed, {.low = speed, .high = 1e13});
  q.loose_stress = table->number_or("loose_stress", loose * youngs_modulus, stress_or_zero);
  q.places = table->places();
  table->finish();
  return q;
}

Stage read_stage(TableReader table, std::size_t number, const StageContext& context) {
  std::vector<std::string> types, all_keys;
  for (const StageKeyword& keyword : stage_keywords()) {
    types.push_back(keyword.name);
    all_keys.insert(all_keys.end(), keyword.keys.begin(), keyword.keys.end());
  }
  const std::string type = table.choice("type", types);
  Stage stage;
  stage.name = table.string_or("name", fmt::format("{}-{}", type, number));
  constexpr std::size_t longest_name = 64;
  check_name(table, stage.name, longest_name);
  const auto keyword = std::find_if(stage_keywords().begin(), stage_keywords().end(),
                                    [&](const StageKeyword& known) { return known.name == type; });
  refuse_foreign_keys(table, all_keys, keyword->keys, fmt::format("type = '{}'", type));
  stage.type = keyword->read(table, context);
  if (std::holds_alternative<ToolLoading>(stage.type) && table.has("quasi_static"))
    table.fail("quasi_static", "cannot be used with type = 'tools'");
  stage.quasi_static = read_quasi_static(table, driven_speed(stage.type), context.youngs_modulus);
  stage.damping = read_damping(table);
  stage.snapshots = static_cast<int>(table.integer_or("snapshots", 0, Range::between(0, 1000)));
  stage.places = table.places();
  table.finish();
  return stage;
}

} // namespace

std::vector<Stage> read_stages(TableReader& root, const StageContext& context) {
  std::vector<TableReader> tables = root.tables("stages");
  if (tables.empty())
    root.fail("stages", root.has("stages") ? "found no stage, allowed: at least one [[stages]]"
                                           : "missing, allowed: at least one [[stages]]");
  std::vector<Stage> stages;
  std::set<std::string> names;
  for (TableReader& table : tables) {
    stages.push_back(read_stage(table, stages.size() + 1, context));
    const std::string& name = stages.back().name;
    if (!names.insert(name).second)
      table.fail("name", fmt::format("found '{}', the name of an earlier stage, allowed: different names", name));
  }
  return stages;
}

} // namespace mpfem
