#include "solver/output/tool_geometry.hpp"

#include <cmath>
#include <span>

#include "results-schema/descriptors.hpp"

namespace mpfem {

namespace {

namespace run = schema::run;

/// Writes the parameters of one tool's surface.
class GeometryWriter {
public:
  GeometryWriter(schema::FileWriter& file, const std::string& tool) : file_(file), tool_(tool) {}

  void operator()(const OrientedPlane& plane) const {
    begin("plane", false);
    vector(run::tools_point, plane.point);
    vector(run::tools_direction, plane.normal);
  }
  void operator()(const CylinderSurface& cylinder) const {
    begin("cylinder", cylinder.inside);
    vector(run::tools_point, cylinder.centre);
    vector(run::tools_direction, along_axis(cylinder.axis, 1));
    number(run::tools_radius, cylinder.radius);
    if (std::isfinite(cylinder.half_length)) number(run::tools_half_length, cylinder.half_length);
    number(run::tools_rounding, cylinder.rounding);
  }
  void operator()(const SphereSurface& sphere) const {
    begin("sphere", sphere.inside);
    vector(run::tools_point, sphere.centre);
    number(run::tools_radius, sphere.radius);
  }
  void operator()(const ConeSurface& cone) const {
    begin("cone", cone.inside);
    vector(run::tools_point, cone.apex);
    vector(run::tools_direction, along_axis(cone.axis, cone.direction));
    number(run::tools_half_angle, std::atan2(cone.sine, cone.cosine));
  }
  void operator()(const BodySurface& body) const {
    begin("triangles", body.triangles->side() == GrainSide::inside);
    std::vector<double> vertex;
    std::vector<std::int32_t> triangle;
    for (const Vector3<double>& x : body.mesh->vertex) vertex.insert(vertex.end(), {x.x, x.y, x.z});
    for (const auto& corners : body.mesh->triangle) triangle.insert(triangle.end(), corners.begin(), corners.end());
    file_.write(run::tools_vertex, std::span<const double>(vertex), vertex.size() / 3, tool_);
    file_.write(run::tools_triangle, std::span<const std::int32_t>(triangle), triangle.size() / 3, tool_);
  }

private:
  void begin(const char* shape, bool inside) const {
    file_.write_scalar(run::tools_shape, std::string(shape), tool_);
    file_.write_scalar(run::tools_inside, std::int32_t{inside}, tool_);
  }
  template <class Dataset>
  void vector(const Dataset& dataset, const Vector3<double>& v) const {
    const double values[] = {v.x, v.y, v.z};
    file_.write(dataset, std::span<const double>(values), 3, tool_);
  }
  template <class Dataset>
  void number(const Dataset& dataset, double value) const {
    file_.write_scalar(dataset, value, tool_);
  }

  schema::FileWriter& file_;
  const std::string& tool_;
};

} // namespace

void write_tool_geometry(schema::FileWriter& file, const Tools& tools) {
  for (std::size_t i = 0; i < tools.size(); ++i) std::visit(GeometryWriter(file, tools[i].name), tools[i].surface);
}

void write_placed_tools(schema::FileWriter& file, const std::string& snapshot, const Tools& tools) {
  if (!tools.present()) return;
  std::vector<std::string> name;
  std::vector<double> displacement;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (tools[i].away) continue;
    name.push_back(tools[i].name);
    displacement.insert(displacement.end(), tools[i].moved.begin(), tools[i].moved.end());
  }
  file.write(run::snapshots_tool_name, std::span<const std::string>(name), name.size(), snapshot);
  file.write(run::snapshots_tool_displacement, std::span<const double>(displacement), name.size(), snapshot);
}

} // namespace mpfem
