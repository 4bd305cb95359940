#include "pack-gen/sphere_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "common/version.hpp"
#include "results-schema/file.hpp"
#include "results-schema/packing_file.hpp"

namespace mpfem {

namespace {

namespace file = schema::packing;
using Doubles = std::span<const double>;
using Integers = std::span<const std::int32_t>;

void write_surface(schema::FileWriter& writer, const TriangleMesh& mesh) {
  std::vector<double> vertex;
  std::vector<std::int32_t> triangle;
  for (const Vector3<double>& x : mesh.vertex) vertex.insert(vertex.end(), {x.x, x.y, x.z});
  for (const auto& corners : mesh.triangle) triangle.insert(triangle.end(), corners.begin(), corners.end());
  writer.write(file::box_vertex, Doubles(vertex), mesh.vertex.size());
  writer.write(file::box_triangle, Integers(triangle), mesh.triangle.size());
}

std::shared_ptr<const SurfaceContainer> surface_of_file(const schema::FileReader& reader, const std::string& path) {
  const auto fail = [&](const auto& dataset, const std::string& what) {
    throw InputError(fmt::format("{}: dataset {}: {}", one_line(path), dataset.path, what));
  };
  if (!reader.has(file::box_vertex) || !reader.has(file::box_triangle))
    fail(file::box_shape, "found surface, allowed: only together with /box/vertex and /box/triangle");
  const auto vertex = reader.read(file::box_vertex);
  const auto triangle = reader.read(file::box_triangle);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertex.size(); i += 3) {
    if (!std::isfinite(vertex[i] + vertex[i + 1] + vertex[i + 2]))
      fail(file::box_vertex, fmt::format("found no finite number at index {}, allowed: finite", i / 3));
    mesh.vertex.push_back({vertex[i], vertex[i + 1], vertex[i + 2]});
  }
  for (std::size_t i = 0; i < triangle.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k)
      if (triangle[i + k] < 0 || static_cast<std::size_t>(triangle[i + k]) >= mesh.vertex.size())
        fail(file::box_triangle, fmt::format("found vertex {} at index [{}, {}], allowed: 0 … {}", triangle[i + k],
                                             i / 3, k, mesh.vertex.size() - 1));
    mesh.triangle.push_back({triangle[i], triangle[i + 1], triangle[i + 2]});
  }
  if (mesh.triangle.empty()) fail(file::box_triangle, "found no triangle, allowed: a closed surface");
  return place_surface(std::move(mesh)).container;
}

} // namespace

void tabulate_target(const SizeDistribution& distribution, double scale, PackingOrigin& origin) {
  constexpr int points = 101;
  const double smallest = distribution.quantile(0), largest = distribution.quantile(1);
  for (int i = 0; i < points; ++i) {
    const double diameter = smallest + (largest - smallest) * i / (points - 1);
    origin.target_diameter.push_back(scale * diameter);
    origin.target_cumulative_number.push_back(distribution.cumulative_number(diameter));
  }
}

SphereFile read_spheres(const std::string& path) {
  const schema::FileReader reader(path, schema::FileKind::packing);
  SphereFile result;
  schema::PackingSpheres spheres = schema::read_packing_spheres(reader);
  std::copy_n(spheres.box_lengths.begin(), 3, result.packing.box.begin());
  result.packing.shape = spheres.shape;
  if (spheres.shape == ContainerShape::surface) result.packing.surface = surface_of_file(reader, path);
  for (std::size_t i = 0; i < spheres.radius.size(); ++i)
    result.packing.center.push_back({spheres.center[3 * i], spheres.center[3 * i + 1], spheres.center[3 * i + 2]});
  result.packing.radius = std::move(spheres.radius);
  if (reader.has(file::packing_seed)) result.origin.seed = reader.read_scalar(file::packing_seed);
  if (reader.has(file::packing_description)) result.origin.description = reader.read_scalar(file::packing_description);
  if (reader.has(file::packing_target_diameter)) {
    result.origin.target_diameter = reader.read(file::packing_target_diameter);
    result.origin.target_cumulative_number = reader.read(file::packing_target_cumulative_number);
  }
  return result;
}

void export_spheres(const std::string& path, const SpherePacking& packing) {
  std::string text = "x [mm],y [mm],z [mm],radius [mm]\n";
  for (std::size_t i = 0; i < packing.radius.size(); ++i)
    text += fmt::format("{},{},{},{}\n", packing.center[i][0], packing.center[i][1], packing.center[i][2],
                        packing.radius[i]);
  write_file(path, text);
}

void write_packing_file(const std::string& path, const SpherePacking& packing, const PackingOrigin& origin,
                        const std::optional<MeshForFile>& mesh) {
  schema::FileWriter writer(path, schema::FileKind::packing, fmt::format("pack-gen {}", version_and_commit()));
  std::vector<double> center;
  for (const auto& c : packing.center) center.insert(center.end(), c.begin(), c.end());
  const std::size_t spheres = packing.radius.size();
  writer.write(file::box_lengths, Doubles(packing.box), 3);
  // Files of boxes stay as before, for programs that do not know shapes.
  if (packing.shape != ContainerShape::box) writer.write_scalar(file::box_shape, std::string(name_of(packing.shape)));
  if (packing.surface) write_surface(writer, packing.surface->mesh);
  writer.write(file::spheres_center, Doubles(center), spheres);
  writer.write(file::spheres_radius, Doubles(packing.radius), spheres);
  const bool halves = mesh && mesh->hemispheres;
  const double gap = halves ? smallest_sphere_gap(packing).gap : smallest_gap(packing).gap;
  if (std::isfinite(gap)) writer.write_scalar(file::packing_smallest_gap, gap);
  writer.write_scalar(file::packing_relative_density, (halves ? 0.5 : 1.0) * relative_density(packing));
  if (origin.seed) writer.write_scalar(file::packing_seed, *origin.seed);
  writer.write_scalar(file::packing_description, origin.description);
  if (!origin.target_diameter.empty()) {
    writer.write(file::packing_target_diameter, Doubles(origin.target_diameter), origin.target_diameter.size());
    writer.write(file::packing_target_cumulative_number, Doubles(origin.target_cumulative_number),
                 origin.target_diameter.size());
  }
  if (mesh) {
    const PackingMesh& m = *mesh->mesh;
    writer.write(file::mesh_node, Doubles(m.node), m.node.size() / 3);
    writer.write(file::mesh_tet, Integers(m.tet), m.tet.size() / 4);
    writer.write(file::mesh_grain_node_offset, Integers(m.grain_node_offset), m.grain_node_offset.size());
    writer.write(file::mesh_grain_tet_offset, Integers(m.grain_tet_offset), m.grain_tet_offset.size());
    writer.write_scalar(file::mesh_nominal_size, mesh->nominal_size);
    writer.write_scalar(file::mesh_smallest_facet_gap, mesh->smallest_facet_gap);
    writer.write_scalar(file::mesh_smallest_quality, mesh->smallest_quality);
  }
  writer.commit();
}

MeshFromFile read_mesh(const std::string& path) {
  const schema::FileReader reader(path, schema::FileKind::packing);
  if (!reader.has(file::mesh_tet))
    throw InputError(
        fmt::format("{}: found a packing without meshes, allowed: a meshed one; pack-gen mesh makes it", path));
  MeshFromFile result;
  schema::PackingTets mesh = schema::read_packing_tets(reader, reader.rows(file::spheres_radius));
  result.mesh.node = std::move(mesh.node);
  result.mesh.tet = std::move(mesh.tet);
  result.mesh.grain_node_offset = std::move(mesh.grain_node_offset);
  result.mesh.grain_tet_offset = std::move(mesh.grain_tet_offset);
  if (reader.has(file::mesh_nominal_size)) result.nominal_size = reader.read_scalar(file::mesh_nominal_size);
  return result;
}

} // namespace mpfem
