#include "solver/scenario/read_tools.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "solver/scenario/common_keys.hpp"
#include "solver/scenario/ranges.hpp"
#include "solver/scenario/read_bond.hpp"

namespace mpfem {

namespace {

using Vector = std::array<double, 3>;

bool read_inside(TableReader& table, const char* usual) {
  return table.choice_or("grains", usual, {"inside", "outside"}) == "inside";
}

ToolShape read_plane(TableReader& table) {
  PlaneShape plane;
  if (table.has("face")) {
    static const std::vector<std::string> faces{"-x", "+x", "-y", "+y", "-z", "+z"};
    const std::string face = table.choice("face", faces);
    for (const char* key : {"point", "normal"})
      if (table.has(key)) table.fail(key, "cannot be used with 'face'");
    plane.face = static_cast<std::size_t>(std::find(faces.begin(), faces.end(), face) - faces.begin());
    plane.normal = {};
    plane.normal[*plane.face / 2] = *plane.face % 2 == 0 ? 1.0 : -1.0;
    return plane;
  }
  plane.point = table.vector3("point", any_length);
  plane.normal = table.vector3("normal", Range::between(-1e9, 1e9));
  if (const auto& n = plane.normal; !(std::hypot(n[0], n[1], n[2]) > 1e-9))
    table.fail("normal", "found a vector of length 0, allowed: the direction towards the grains");
  return plane;
}

ToolShape read_cylinder(TableReader& table) {
  CylinderShape cylinder;
  cylinder.axis = read_axis(table);
  if (table.has("centre")) cylinder.centre = table.vector3("centre", any_length);
  cylinder.radius = table.optional_number("radius", positive_length);
  cylinder.inside = read_inside(table, "inside");
  if (table.has("extent")) {
    const std::vector<double> extent = table.numbers("extent", any_length);
    if (extent.size() != 2 || !(extent[0] < extent[1]))
      table.fail("extent", "allowed: two numbers, [low, high] with low < high (mm along the axis)");
    cylinder.extent = {extent[0], extent[1]};
  }
  cylinder.rounding = table.number_or("rounding", 0, Range::between(0, 1e9));
  if (cylinder.rounding > 0 && !cylinder.extent) table.fail("rounding", "is used only with 'extent'");
  const double most = cylinder.extent ? 0.5 * ((*cylinder.extent)[1] - (*cylinder.extent)[0]) : 0;
  if (cylinder.rounding > most && cylinder.extent)
    table.fail("rounding",
               fmt::format("found {:g} mm, allowed: up to half of the extent, {:g} mm", cylinder.rounding, most));
  return cylinder;
}

ToolShape read_sphere(TableReader& table) {
  return SphereShape{.centre = table.vector3("centre", any_length),
                     .radius = table.number("radius", positive_length),
                     .inside = read_inside(table, "outside")};
}

ToolShape read_cone(TableReader& table) {
  constexpr double degree = std::numbers::pi / 180;
  ConeShape cone;
  cone.axis = read_axis(table);
  cone.direction = table.choice_or("opens", "up", {"up", "down"}) == "up" ? 1.0 : -1.0;
  cone.apex = table.vector3("apex", any_length);
  cone.half_angle = degree * table.number("half_angle", Range::between(1, 89));
  cone.inside = read_inside(table, "inside");
  return cone;
}

ToolShape read_stl_shape(TableReader& table) {
  StlShape stl;
  stl.file = table.string("file");
  if (stl.file.empty() || stl.file.find('\0') != std::string::npos)
    table.fail("file", "found an empty or unusable path, allowed: an STL file");
  stl.scale = table.number("scale", length_of_unit); // no default: STL files do not state their unit
  stl.inside = read_inside(table, "outside");
  if (table.has("low_corner")) stl.low_corner = table.vector3("low_corner", any_length);
  return stl;
}

struct ShapeKeyword {
  std::string name;
  std::vector<std::string> keys;
  ToolShape (*read)(TableReader&);
};

const std::vector<ShapeKeyword>& shape_keywords() {
  static const std::vector<ShapeKeyword> keywords = {
      {shape_name(PlaneShape{}), {"face", "point", "normal"}, read_plane},
      {shape_name(CylinderShape{}), {"axis", "centre", "radius", "grains", "extent", "rounding"}, read_cylinder},
      {shape_name(SphereShape{}), {"centre", "radius", "grains"}, read_sphere},
      {shape_name(ConeShape{}), {"axis", "opens", "apex", "half_angle", "grains"}, read_cone},
      {shape_name(StlShape{}), {"file", "scale", "grains", "low_corner"}, read_stl_shape},
  };
  return keywords;
}

ToolParameters read_tool(TableReader& table) {
  std::vector<std::string> types, all_keys;
  for (const ShapeKeyword& keyword : shape_keywords()) {
    types.push_back(keyword.name);
    all_keys.insert(all_keys.end(), keyword.keys.begin(), keyword.keys.end());
  }
  ToolParameters tool;
  tool.name = table.string("name");
  constexpr std::size_t longest_name = 32;
  check_name(table, tool.name, longest_name);
  const std::string type = table.choice("type", types);
  const auto keyword = std::find_if(shape_keywords().begin(), shape_keywords().end(),
                                    [&](const ShapeKeyword& known) { return known.name == type; });
  refuse_foreign_keys(table, all_keys, keyword->keys, fmt::format("type = '{}'", type));
  tool.shape = keyword->read(table);
  tool.friction = table.number_or("friction", 0, friction_or_zero);
  if (auto adhesion = table.optional_table("adhesion")) {
    tool.adhesion_places = adhesion->places();
    tool.adhesion = read_bond(*adhesion);
    if (tool.adhesion->normal_only) adhesion->fail("normal_only", "found true, allowed: false for a tool");
  }
  table.finish();
  return tool;
}

/// The direction of a drive: that of the tool, unless the key `direction` gives another; none if there is neither.
std::optional<Vector> read_direction(TableReader& table, const ToolShape& shape) {
  if (!table.has("direction")) return direction_of(shape);
  if (std::holds_alternative<PlaneShape>(shape))
    table.fail("direction", "found for a plane, which moves along its normal, allowed: another tool");
  for (const char* key : {"velocity", "stress"})
    if (table.has(key)) table.fail("direction", "is used only with 'speed' or 'force'");
  const Vector given = table.vector3("direction", Range::between(-1e6, 1e6));
  const double length = std::hypot(given[0], given[1], given[2]);
  if (!(length > 0)) table.fail("direction", "found a vector of length 0, allowed: the direction of the push");
  return Vector{given[0] / length, given[1] / length, given[2] / length};
}

/// Reads what one tool does; `is_punch`: it is a punch of the container.
ToolDrive read_drive(TableReader table, std::size_t tool, const ToolShape& shape, bool is_punch) {
  ToolDrive drive{.tool = tool};
  const auto direction = read_direction(table, shape);
  drive.direction = direction.value_or(Vector{});
  const auto given = static_cast<int>(table.has("speed")) + static_cast<int>(table.has("velocity")) +
                     static_cast<int>(table.has("force")) + static_cast<int>(table.has("stress"));
  if (given != 1)
    table.fail("speed",
               fmt::format("found {} of the keys speed, velocity, force and stress, allowed: one of them", given));
  if (table.has("velocity")) drive.velocity = table.vector3("velocity", any_speed);
  if (table.has("speed")) {
    const double speed = table.number("speed", any_speed);
    for (std::size_t axis = 0; axis < 3; ++axis) drive.velocity[axis] = speed * drive.direction[axis];
  }
  if (table.has("force")) {
    constexpr double largest_force = 1e15; // N
    drive.force = table.number("force", Range::between(-largest_force, largest_force));
  } else if (table.has("stress")) {
    if (!is_punch) table.fail("stress", "is used only for the punches of [container]; other tools hold a 'force'");
    drive.stress = table.number("stress", stress_or_zero);
  }
  if (drive.holds_push())
    drive.servo_speed = table.number("servo_speed", positive_speed);
  else if (table.has("servo_speed"))
    table.fail("servo_speed", "is used only with 'force' or 'stress'");
  table.finish(); // first: a misspelled key is the cause of one that is missing
  if (!direction && !table.has("velocity"))
    table.fail("velocity",
               "missing, allowed: a vector, or 'speed' or 'force' with a 'direction'; this tool has no axis or normal");
  return drive;
}

} // namespace

std::vector<ToolParameters> read_tools(TableReader& root, const std::string& scenario_file) {
  std::vector<ToolParameters> tools;
  std::set<std::string> names;
  for (TableReader& table : root.tables("tools")) {
    tools.push_back(read_tool(table));
    tools.back().places = table.places();
    if (auto* stl = std::get_if<StlShape>(&tools.back().shape))
      stl->file = (std::filesystem::path(scenario_file).parent_path() / stl->file).lexically_normal().string();
    const std::string& name = tools.back().name;
    if (!names.insert(name).second)
      table.fail("name", fmt::format("found '{}', the name of an earlier tool, allowed: different names", name));
  }
  return tools;
}

std::size_t tool_named(const TableReader& table, std::string_view key, const std::string& name,
                       std::span<const ToolParameters> tools) {
  const auto found =
      std::find_if(tools.begin(), tools.end(), [&](const ToolParameters& tool) { return tool.name == name; });
  if (found != tools.end()) return static_cast<std::size_t>(found - tools.begin());
  std::string known;
  for (const ToolParameters& tool : tools) known += (known.empty() ? "" : ", ") + tool.name;
  table.fail(key, tools.empty() ? fmt::format("found the tool '{}', but the scenario has no [[tools]]", name)
                                : fmt::format("found the tool '{}', allowed: one of {}", name, known));
}

namespace {

void check_plane(const TableReader& table, const char* key, const ToolParameters& tool, const Vector& normal) {
  if (!std::holds_alternative<PlaneShape>(tool.shape) || *direction_of(tool.shape) != normal)
    table.fail(key, fmt::format("found '{}', allowed: a plane whose normal is [{:g}, {:g}, {:g}]", tool.name, normal[0],
                                normal[1], normal[2]));
}

/// The tools at the faces -x, +x, -y, +y: those of a list of four planes, or one die.
std::array<std::size_t, 4> read_container_wall(TableReader& table, std::span<const ToolParameters> tools) {
  std::array<std::size_t, 4> wall{};
  if (const toml::node* found = table.value("wall"); found != nullptr && found->is_array()) {
    const std::vector<std::string> names = table.strings_or("wall", {});
    if (names.size() != wall.size())
      table.fail("wall",
                 fmt::format("found {} names, allowed: one die or the four planes at -x, +x, -y and +y", names.size()));
    for (std::size_t side = 0; side < wall.size(); ++side) {
      wall[side] = tool_named(table, "wall", names[side], tools);
      Vector normal{};
      normal[side / 2] = side % 2 == 0 ? 1 : -1;
      check_plane(table, "wall", tools[wall[side]], normal);
    }
    return wall;
  }
  wall.fill(tool_named(table, "wall", table.string("wall"), tools));
  const ToolParameters& die = tools[wall[0]];
  const auto* cylinder = std::get_if<CylinderShape>(&die.shape);
  const auto* stl = std::get_if<StlShape>(&die.shape);
  const bool bore = cylinder != nullptr && cylinder->axis == 2 && cylinder->inside;
  if (!bore && !(stl != nullptr && stl->inside))
    table.fail("wall", fmt::format("found '{}', allowed: a cylinder along z or an STL surface with the grains inside, "
                                   "or a list of four planes",
                                   die.name));
  return wall;
}

} // namespace

std::optional<ContainerParameters> read_container(TableReader& root, std::span<const ToolParameters> tools) {
  auto table = root.optional_table("container");
  if (!table) return std::nullopt;
  const auto punch = [&](const char* key, double sign) {
    const std::size_t found = tool_named(*table, key, table->string(key), tools);
    check_plane(*table, key, tools[found], {0, 0, sign});
    return found;
  };
  ContainerParameters container{.wall = read_container_wall(*table, tools)};
  container.lower = punch("lower", 1);
  container.upper = punch("upper", -1);
  table->finish();
  return container;
}

std::vector<ToolDrive> read_drives(TableReader& stage, std::span<const ToolParameters> tools,
                                   const std::optional<ContainerParameters>& container) {
  std::vector<ToolDrive> drives;
  auto table = stage.optional_table("drive");
  if (!table) return drives;
  for (const std::string& name : table->keys()) {
    const std::size_t tool = tool_named(*table, name, name, tools);
    const bool is_punch = container && (tool == container->lower || tool == container->upper);
    drives.push_back(read_drive(table->table(name), tool, tools[tool].shape, is_punch));
  }
  table->finish();
  std::sort(drives.begin(), drives.end(), [](const ToolDrive& a, const ToolDrive& b) { return a.tool < b.tool; });
  return drives;
}

} // namespace mpfem
