#include "solver/run/make_tools.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "solver/model/material.hpp"
#include "surfaces/stl.hpp"
#include "surfaces/stl_size.hpp"

namespace mpfem {

namespace {

OrientedPlane surface_of(const PlaneShape& shape, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  const std::array<double, 3> direction = *direction_of(shape);
  std::array<double, 3> point = shape.point;
  if (shape.face) {
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = 0.5 * (low[axis] + high[axis]);
    const std::size_t axis = *shape.face / 2;
    point[axis] = *shape.face % 2 == 0 ? low[axis] : high[axis];
  }
  return {vector_of(point), vector_of(direction)};
}

CylinderSurface surface_of(const CylinderShape& shape, const std::array<double, 3>& low,
                           const std::array<double, 3>& high) {
  std::array<double, 3> centre{};
  for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = 0.5 * (low[axis] + high[axis]);
  if (shape.centre) centre = *shape.centre;
  double half_length = std::numeric_limits<double>::infinity();
  if (shape.extent) {
    half_length = 0.5 * ((*shape.extent)[1] - (*shape.extent)[0]);
    centre[shape.axis] = 0.5 * ((*shape.extent)[0] + (*shape.extent)[1]);
  }
  const std::size_t across[2] = {(shape.axis + 1) % 3, (shape.axis + 2) % 3};
  const double half_box = 0.5 * std::min(high[across[0]] - low[across[0]], high[across[1]] - low[across[1]]);
  return {shape.axis, vector_of(centre), shape.radius.value_or(half_box), shape.inside, half_length, shape.rounding};
}

SphereSurface surface_of(const SphereShape& shape, const std::array<double, 3>& /*low*/,
                         const std::array<double, 3>& /*high*/) {
  return {vector_of(shape.centre), shape.radius, shape.inside};
}

ConeSurface surface_of(const ConeShape& shape, const std::array<double, 3>& /*low*/,
                       const std::array<double, 3>& /*high*/) {
  return {shape.axis,  shape.direction, vector_of(shape.apex), std::sin(shape.half_angle), std::cos(shape.half_angle),
          shape.inside};
}

BodySurface surface_of(const StlShape& shape, const std::array<double, 3>& /*low*/,
                       const std::array<double, 3>& /*high*/) {
  StlBody body = read_stl(shape.file, shape.scale);
  Bounds& b = body.findings.bounds;
  if (shape.low_corner) {
    std::array<double, 3> shift{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      shift[axis] = (*shape.low_corner)[axis] - b.low[axis];
      b.low[axis] += shift[axis], b.high[axis] += shift[axis];
    }
    for (Vector3<double>& corner : body.mesh.vertex) corner = corner + vector_of(shift);
  }
  // One step after a node has left the surface, it is still this near to it.
  constexpr double near = 1e-4; // of the body's diagonal
  const double diagonal = std::hypot(b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]);
  const Vector3<double> centre{0.5 * (b.low[0] + b.high[0]), 0.5 * (b.low[1] + b.high[1]),
                               0.5 * (b.low[2] + b.high[2])};
  const GrainSide side = shape.inside ? GrainSide::inside : GrainSide::outside;
  return {std::make_shared<const TriangulatedSurface>(body.mesh, side), centre, near * diagonal,
          std::make_shared<const TriangleMesh>(body.mesh)};
}

/// Size of the body of an STL tool; none for other shapes.
std::optional<StlSize> size_of(const ToolShape& shape, const ToolSurface& surface) {
  const auto* stl = std::get_if<StlShape>(&shape);
  if (stl == nullptr) return {};
  return StlSize{stl->file, "scale", stl->scale, lengths_of(std::get<BodySurface>(surface).triangles->bounds())};
}

std::array<double, 3> box_of(const Model& model) {
  return lengths_of({model.box_low, model.box_high});
}

/// The smallest gap (mm) between a tool and the corners of a box; negative if it is behind the surface.
double gap_to_corners(const ToolSurface& surface, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto coordinate = [&](std::size_t i) { return ((corner >> i) & 1U) != 0 ? high[i] : low[i]; };
    std::visit([&](const auto& s) { smallest = std::min(smallest, gap_at_any_distance(s, coordinate).distance); },
               surface);
  }
  return smallest;
}

/// "cylinder with radius = 500 mm", "plane".
std::string shape_text(const ToolShape& shape, const ToolSurface& surface) {
  std::string text = shape_name(shape);
  if (const auto* cylinder = std::get_if<CylinderSurface>(&surface))
    text += fmt::format(" with radius = {:g} mm", cylinder->radius);
  if (const auto* sphere = std::get_if<SphereSurface>(&surface))
    text += fmt::format(" with radius = {:g} mm", sphere->radius);
  return text;
}

/// A line if the scale of an STL tool is probably wrong: it encloses the packing and is far larger, or is a body that
/// is far smaller. (A body may be far larger, such as a plate, and a grain in it is refused.) Empty for others.
std::string implausible_body(const ToolShape& shape, const Tool& tool, const Model& model) {
  const auto size = size_of(shape, tool.surface);
  if (!size) return {};
  const bool encloses = std::get<StlShape>(shape).inside;
  const double ratio = mean_ratio(*size, box_of(model));
  if ((encloses ? ratio : 1 / ratio) <= unlikely_ratio) return {};
  return fmt::format("tool '{}' is far {} than the packing: {}", tool.name, encloses ? "larger" : "smaller", tool.size);
}

/// Whether a tool is a round wall about the packing.
bool surrounds(const ToolSurface& surface) {
  const auto* cylinder = std::get_if<CylinderSurface>(&surface);
  const auto* sphere = std::get_if<SphereSurface>(&surface);
  return (cylinder != nullptr && cylinder->inside) || (sphere != nullptr && sphere->inside);
}

/// A line if the tool of a scenario is so far from the packing that it is probably given in another unit; else empty.
std::string implausible_distance(const ToolShape& shape, const Tool& tool, const Model& model) {
  // Lengths in micrometres or metres are wrong by 1,000: then the wall of a die is 500 diameters away. A wall about the
  // packing is no further away than this, unless the packing fills less than 1 % of it.
  constexpr double far_wall = 0.5 * unlikely_ratio, far_tool = 100; // mean edges of the packing's box
  const double unlikely_distance = surrounds(tool.surface) ? far_wall : far_tool;
  const std::array<double, 3> box = box_of(model);
  const double gap = gap_to_corners(tool.surface, model.box_low, model.box_high);
  if (gap <= unlikely_distance * std::cbrt(box[0] * box[1] * box[2])) return {};
  const std::string text =
      fmt::format("tool '{}' ({}) is {:.4g} mm away from the packing", tool.name, shape_text(shape, tool.surface), gap);
  if (!tool.size.empty()) return text + ": " + tool.size;
  return text + fmt::format(", whose box is only {} (lengths are in mm)", edges_text(box));
}

/// Identifies the triangles of a surface.
std::uint64_t hash_of(const TriangleMesh& mesh) {
  static_assert(sizeof(Vector3<double>) == 3 * sizeof(double)); // no padding
  return hash_bytes(std::as_bytes(std::span(mesh.triangle)), hash_bytes(std::as_bytes(std::span(mesh.vertex))));
}

/// The surface of a scenario's tool in the packing's box. A refusal names the key of its STL file.
ToolSurface surface_in(const Model& model, const ToolParameters& tool) {
  try {
    return make_surface(tool.shape, model.box_low, model.box_high);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}tool '{}': key 'file': {}", tool.places.prefix("file"), tool.name, error.what()));
  }
}

} // namespace

ToolSurface make_surface(const ToolShape& shape, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  return std::visit([&](const auto& of_shape) { return ToolSurface(surface_of(of_shape, low, high)); }, shape);
}

Tools make_tools(const Scenario& scenario, const Model& model) {
  std::vector<Tool> tools;
  for (const ToolParameters& parameters : scenario.tools) {
    Tool tool{.name = parameters.name, .surface = surface_in(model, parameters), .friction = parameters.friction};
    if (const auto* body = std::get_if<BodySurface>(&tool.surface)) tool.triangles = hash_of(*body->mesh);
    if (const auto size = size_of(parameters.shape, tool.surface))
      tool.size = size_beside(*size, "the packing's box", box_of(model));
    if (const auto& adhesion = parameters.adhesion)
      tool.adhesion = {law_of_bonds(*adhesion, scenario.contact), adhesion->rebond_on_contact};
    tools.push_back(std::move(tool));
  }
  return {std::move(tools), model.grains};
}

std::vector<std::string> implausible_sizes(const Scenario& scenario, const Model& model, const Tools& tools) {
  std::vector<std::string> remarks;
  for (std::size_t tool = 0; tool < tools.size(); ++tool) {
    const ToolShape& shape = scenario.tools[tool].shape;
    std::string remark = implausible_body(shape, tools[tool], model);
    if (remark.empty()) remark = implausible_distance(shape, tools[tool], model);
    if (!remark.empty()) remarks.push_back(remark);
  }
  return remarks;
}

} // namespace mpfem
