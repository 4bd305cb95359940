#include "postproc/run_data/tool_geometry.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

namespace run = schema::run;

constexpr std::array shape_names = {"plane", "cylinder", "sphere", "cone", "triangles"};

[[noreturn]] void refuse(const schema::FileReader& file, const std::string& tool, const std::string& what) {
  throw InputError(fmt::format("{}: tool '{}': {}", one_line(file.path()), one_line(tool), what));
}

ToolKind shape_of(const schema::FileReader& file, const std::string& tool) {
  const std::string name = file.read_scalar(run::tools_shape, tool);
  const auto* const found = std::find(shape_names.begin(), shape_names.end(), name);
  if (found == shape_names.end())
    refuse(file, tool, fmt::format("shape '{}', allowed: {}", one_line(name), fmt::join(shape_names, ", ")));
  return static_cast<ToolKind>(found - shape_names.begin());
}

template <class T>
std::vector<std::array<T, 3>> rows_of(const std::vector<T>& values) {
  std::vector<std::array<T, 3>> rows;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) rows.push_back({values[i], values[i + 1], values[i + 2]});
  return rows;
}

void read_triangles(const schema::FileReader& file, ToolGeometry& tool) {
  tool.vertex = rows_of(file.read(run::tools_vertex, tool.name));
  tool.triangle = rows_of(file.read(run::tools_triangle, tool.name));
  for (const auto& corners : tool.triangle)
    for (const std::int32_t corner : corners)
      if (corner < 0 || static_cast<std::size_t>(corner) >= tool.vertex.size())
        refuse(file, tool.name,
               fmt::format("a triangle has vertex {}, allowed: one below {}", corner, tool.vertex.size()));
}

/// Throws InputError unless the direction has length 1 and, for shapes with an axis, is along a coordinate axis.
void check_direction(const schema::FileReader& file, const ToolGeometry& tool) {
  const auto& d = tool.direction;
  const double length = std::hypot(d[0], d[1], d[2]), longest = std::abs(d[tool.axis()]);
  const bool is_axis = tool.shape != ToolKind::plane;
  if (std::abs((is_axis ? longest : length) - 1) > 1e-9 || std::abs(length - 1) > 1e-9)
    refuse(file, tool.name,
           fmt::format("direction {:g}, {:g}, {:g}, allowed: a unit vector{}", d[0], d[1], d[2],
                       is_axis ? " along x, y or z" : ""));
}

/// Reads a tool in its starting position.
ToolGeometry read_tool(const schema::FileReader& file, const std::string& name) {
  ToolGeometry tool;
  tool.name = name;
  tool.shape = shape_of(file, name);
  tool.inside = file.read_scalar(run::tools_inside, name) != 0;
  if (tool.shape == ToolKind::triangles) {
    read_triangles(file, tool);
    return tool;
  }
  tool.point = rows_of(file.read(run::tools_point, name)).at(0);
  if (tool.shape != ToolKind::sphere) {
    tool.direction = rows_of(file.read(run::tools_direction, name)).at(0);
    check_direction(file, tool);
  }
  if (tool.shape == ToolKind::cylinder || tool.shape == ToolKind::sphere)
    tool.radius = file.read_scalar(run::tools_radius, name);
  if (tool.shape == ToolKind::cylinder) {
    if (file.has(run::tools_half_length, name)) tool.half_length = file.read_scalar(run::tools_half_length, name);
    tool.rounding = file.read_scalar(run::tools_rounding, name);
  }
  if (tool.shape == ToolKind::cone) tool.half_angle = file.read_scalar(run::tools_half_angle, name);
  return tool;
}

void move(ToolGeometry& tool, const std::array<double, 3>& by) {
  for (std::size_t k = 0; k < 3; ++k) {
    tool.point[k] += by[k];
    for (auto& vertex : tool.vertex) vertex[k] += by[k];
  }
}

} // namespace

std::size_t ToolGeometry::axis() const {
  const auto longest = std::max_element(direction.begin(), direction.end(),
                                        [](double a, double b) { return std::abs(a) < std::abs(b); });
  return static_cast<std::size_t>(longest - direction.begin());
}

std::vector<ToolGeometry> placed_tools(const schema::FileReader& file, const std::string& snapshot) {
  std::vector<ToolGeometry> tools;
  if (!file.has(run::snapshots_tool_name, snapshot)) return tools;
  const auto names = file.read(run::snapshots_tool_name, snapshot);
  const auto displacement = rows_of(file.read(run::snapshots_tool_displacement, snapshot));
  if (displacement.size() != names.size())
    throw InputError(fmt::format("{}: snapshot {}: {} displacements of {} tools", one_line(file.path()), snapshot,
                                 displacement.size(), names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    tools.push_back(read_tool(file, names[i]));
    move(tools.back(), displacement[i]);
  }
  return tools;
}

} // namespace mpfem
