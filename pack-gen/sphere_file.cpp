#include "pack-gen/sphere_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/version.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

namespace {

namespace file = schema::packing;
using Doubles = std::span<const double>;
using Integers = std::span<const std::int32_t>;

/// Refuses offsets and corners that do not divide nodes and tets among the grains.
void refuse_wrong_numbering(const PackingMesh& mesh, const std::string& path) {
  const auto nodes = static_cast<std::int32_t>(mesh.node.size() / 3),
             tets = static_cast<std::int32_t>(mesh.tet.size() / 4);
  const auto partitions = [](const std::vector<std::int32_t>& offset, std::int32_t end) {
    return !offset.empty() && offset.front() == 0 && offset.back() == end &&
           std::adjacent_find(offset.begin(), offset.end(), std::greater_equal<>()) == offset.end();
  };
  const std::size_t grains = mesh.grain_node_offset.size() - 1;
  if (!partitions(mesh.grain_node_offset, nodes) || !partitions(mesh.grain_tet_offset, tets) ||
      mesh.grain_tet_offset.size() != grains + 1)
    throw InputError(
        fmt::format("{}: the grains' offsets do not divide {} nodes and {} tetrahedra", path, nodes, tets));
  for (std::size_t g = 0; g < grains; ++g)
    for (auto k = 4 * static_cast<std::size_t>(mesh.grain_tet_offset[g]);
         k < 4 * static_cast<std::size_t>(mesh.grain_tet_offset[g + 1]); ++k)
      if (mesh.tet[k] < mesh.grain_node_offset[g] || mesh.tet[k] >= mesh.grain_node_offset[g + 1])
        throw InputError(fmt::format("{}: tetrahedron {} of grain {} has node {}; allowed: {} … {}", path, k / 4, g,
                                     mesh.tet[k], mesh.grain_node_offset[g], mesh.grain_node_offset[g + 1] - 1));
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
  const auto lengths = reader.read(file::box_lengths), center = reader.read(file::spheres_center);
  result.packing.radius = reader.read(file::spheres_radius);
  if (center.size() != 3 * result.packing.radius.size() || result.packing.radius.empty())
    throw InputError(fmt::format("{}: {} centres and {} radii; allowed: as many, at least one", path, center.size() / 3,
                                 result.packing.radius.size()));
  std::copy(lengths.begin(), lengths.end(), result.packing.box.begin());
  for (const double length : lengths)
    if (!(length > 0) || !std::isfinite(length))
      throw InputError(fmt::format("{}: the box has an edge of {:g} mm; allowed: > 0", path, length));
  for (std::size_t i = 0; i < result.packing.radius.size(); ++i) {
    result.packing.center.push_back({center[3 * i], center[3 * i + 1], center[3 * i + 2]});
    if (!(result.packing.radius[i] > 0) ||
        !std::isfinite(center[3 * i] + center[3 * i + 1] + center[3 * i + 2] + result.packing.radius[i]))
      throw InputError(fmt::format("{}: sphere {} has the radius {:g} mm; allowed: finite centre, radius > 0", path, i,
                                   result.packing.radius[i]));
  }
  if (reader.has(file::packing_seed)) result.origin.seed = reader.read_scalar(file::packing_seed);
  if (reader.has(file::packing_description)) result.origin.description = reader.read_scalar(file::packing_description);
  if (reader.has(file::packing_target_diameter)) {
    result.origin.target_diameter = reader.read(file::packing_target_diameter);
    result.origin.target_cumulative_number = reader.read(file::packing_target_cumulative_number);
  }
  return result;
}

void export_spheres(const std::string& path, const SpherePacking& packing) {
  const std::string partial = path + ".partial";
  std::error_code failure;
  std::ofstream out(partial);
  out << "x [mm],y [mm],z [mm],radius [mm]\n";
  for (std::size_t i = 0; i < packing.radius.size(); ++i)
    out << fmt::format("{},{},{},{}\n", packing.center[i][0], packing.center[i][1], packing.center[i][2],
                       packing.radius[i]);
  out.close();
  if (out) std::filesystem::rename(partial, path, failure);
  if (!out || failure) {
    std::filesystem::remove(partial, failure);
    throw StorageError(fmt::format("{}: cannot be written", path));
  }
}

void write_packing_file(const std::string& path, const SpherePacking& packing, const PackingOrigin& origin,
                        const std::optional<MeshForFile>& mesh) {
  schema::FileWriter writer(path, schema::FileKind::packing, fmt::format("pack-gen {}", version_and_commit()));
  std::vector<double> center;
  for (const auto& c : packing.center) center.insert(center.end(), c.begin(), c.end());
  const std::size_t spheres = packing.radius.size();
  writer.write(file::box_lengths, Doubles(packing.box), 3);
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
    throw InputError(fmt::format("{}: a packing without meshes; pack-gen mesh makes them", path));
  MeshFromFile result;
  result.mesh.node = reader.read(file::mesh_node);
  result.mesh.tet = reader.read(file::mesh_tet);
  result.mesh.grain_node_offset = reader.read(file::mesh_grain_node_offset);
  result.mesh.grain_tet_offset = reader.read(file::mesh_grain_tet_offset);
  refuse_wrong_numbering(result.mesh, path);
  for (std::size_t i = 0; i < result.mesh.node.size(); ++i)
    if (!std::isfinite(result.mesh.node[i]))
      throw InputError(fmt::format("{}: /mesh/node row {} is not finite; allowed: finite numbers", path, i / 3));
  if (result.mesh.grain_node_offset.size() != reader.rows(file::spheres_radius) + 1)
    throw InputError(fmt::format("{}: {} meshes for {} spheres; allowed: as many", path,
                                 result.mesh.grain_node_offset.size() - 1, reader.rows(file::spheres_radius)));
  if (reader.has(file::mesh_nominal_size)) result.nominal_size = reader.read_scalar(file::mesh_nominal_size);
  return result;
}

} // namespace mpfem
