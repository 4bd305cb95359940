#include "postproc/run_data/snapshot.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "results-schema/packing_file.hpp"

namespace mpfem {

namespace {

/// Refuses offsets of grains that do not rise from 0 to `count`, the number of `items`.
void check_offsets(const std::vector<std::int32_t>& offset, std::size_t count, const char* dataset, const char* items,
                   const std::string& path) {
  if (offset.empty() || offset.front() != 0 || static_cast<std::size_t>(offset.back()) != count ||
      !std::is_sorted(offset.begin(), offset.end()))
    throw InputError(
        fmt::format("{}: dataset /mesh/{} does not rise from 0 to the number of {}, {}", path, dataset, items, count));
}

std::vector<std::int32_t> grain_of_tets(const std::vector<std::int32_t>& offset, std::size_t tets,
                                        const std::string& path) {
  check_offsets(offset, tets, "grain_tet_offset", "tetrahedra", path);
  return grain_of_each(offset);
}

void check_tets(const Snapshot& s, const std::string& path) {
  for (const std::int32_t node : s.tet)
    if (node < 0 || static_cast<std::size_t>(node) >= s.nodes())
      throw InputError(fmt::format("{}: /mesh/tet names node {}, allowed: 0 … {}", path, node, s.nodes() - 1));
}

void check_size(const std::vector<float>& values, std::size_t expected, std::string_view name,
                const std::string& path) {
  if (values.size() != expected)
    throw InputError(fmt::format("{}: {} has {} values, allowed: {}", path, name, values.size(), expected));
}

/// Throws InputError where a node or the box is not finite: drawing and cutting would never end.
void check_places(const Snapshot& s, const std::string& path) {
  for (std::size_t i = 0; i < s.node.size(); ++i)
    if (!std::isfinite(s.node[i]))
      throw InputError(
          fmt::format("{}: node {} has a position that is not finite, allowed: finite numbers", path, i / 3));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(s.box_low[axis] < s.box_high[axis]) || !std::isfinite(s.box_high[axis] - s.box_low[axis]))
      throw InputError(fmt::format("{}: the box goes from {:g} to {:g} mm, allowed: low < high", path, s.box_low[axis],
                                   s.box_high[axis]));
}

} // namespace

const Field& Snapshot::tet_field(const std::string& field_name) const {
  for (const Field& field : tet_fields)
    if (field.name == field_name) return field;
  std::vector<std::string> names;
  for (const Field& field : tet_fields) names.push_back(field.name);
  for (const Field& field : node_fields)
    if (field.name == "damage") names.push_back(field.name); // the only node field that sections show
  throw InputError(fmt::format("--field: found '{}', allowed: {}", one_line(field_name), fmt::join(names, ", ")));
}

const Field& Snapshot::node_field(const std::string& field_name) const {
  for (const Field& field : node_fields)
    if (field.name == field_name) return field;
  throw InputError(fmt::format("found no field '{}' at the nodes of snapshot {}{}", one_line(field_name), name,
                               field_name == "damage" ? ": the run has no bonds, allowed: a run with bonds" : ""));
}

std::string snapshot_name(const schema::FileReader& file, int number) {
  const auto names = file.snapshots();
  const int count = static_cast<int>(names.size());
  const int index = number < 0 ? count + number : number;
  if (count == 0) throw InputError(fmt::format("{}: the run has no snapshots", one_line(file.path())));
  if (index < 0 || index >= count)
    throw InputError(fmt::format("{}: no snapshot {}, allowed: 0 … {}, or -1 for the last", one_line(file.path()),
                                 number, count - 1));
  return names[static_cast<std::size_t>(index)];
}

std::vector<std::int32_t> grain_node_offsets(const schema::FileReader& file, std::size_t nodes) {
  std::vector<std::int32_t> offset = file.read(schema::run::mesh_grain_node_offset);
  check_offsets(offset, nodes, "grain_node_offset", "nodes", one_line(file.path()));
  return offset;
}

std::vector<std::int32_t> grain_of_each(const std::vector<std::int32_t>& offset) {
  std::vector<std::int32_t> grain(static_cast<std::size_t>(offset.back()));
  for (std::size_t g = 0; g + 1 < offset.size(); ++g)
    std::fill(grain.begin() + offset[g], grain.begin() + offset[g + 1], static_cast<std::int32_t>(g));
  return grain;
}

Snapshot read_snapshot(const schema::FileReader& file, int number) {
  namespace run = schema::run;
  const std::string path = one_line(file.path());
  Snapshot s;
  s.name = snapshot_name(file, number);
  s.time = file.read_scalar(run::snapshots_time, s.name);
  s.relative_density = file.read_scalar(run::snapshots_relative_density, s.name);
  s.mean_stress = file.read_scalar(run::snapshots_mean_stress, s.name);
  const auto low = file.read(run::snapshots_box_low, s.name), high = file.read(run::snapshots_box_high, s.name);
  std::copy(low.begin(), low.end(), s.box_low.begin());
  std::copy(high.begin(), high.end(), s.box_high.begin());
  s.node = file.read(run::snapshots_node, s.name);
  s.velocity = file.read(run::snapshots_velocity, s.name);
  s.tet = file.read(run::mesh_tet);
  s.tet_grain = grain_of_tets(file.read(run::mesh_grain_tet_offset), s.tets(), path);
  check_tets(s, path);
  check_places(s, path);
  const auto field = [&](const auto& dataset, const char* name, std::size_t expected) {
    Field result{name, std::string(dataset.unit), file.read(dataset, s.name)};
    check_size(result.values, expected, dataset.path, path);
    return result;
  };
  s.tet_fields = {field(run::snapshots_von_mises, "von_mises", s.tets()),
                  field(run::snapshots_pressure, "pressure", s.tets()),
                  field(run::snapshots_plastic_strain, "plastic_strain", s.tets())};
  s.node_fields = {field(run::snapshots_contact_pressure, "contact_pressure", s.nodes())};
  if (file.has(run::snapshots_damage, s.name))
    s.node_fields.push_back(field(run::snapshots_damage, "damage", s.nodes()));
  check_size(s.velocity, 3 * s.nodes(), run::snapshots_velocity.path, path);
  s.tet_fields.push_back({"grain", "1", {s.tet_grain.begin(), s.tet_grain.end()}});
  s.tools = placed_tools(file, s.name);
  return s;
}

Snapshot read_packing_snapshot(const std::string& path) {
  namespace packing = schema::packing;
  const schema::FileReader file(path, schema::FileKind::packing);
  if (!file.has(packing::mesh_tet))
    throw InputError(fmt::format("{}: found a packing without meshes, allowed: a meshed one; pack-gen mesh makes it",
                                 one_line(path)));
  Snapshot s;
  s.name = "packing";
  const schema::PackingSpheres spheres = schema::read_packing_spheres(file);
  schema::PackingTets mesh = schema::read_packing_tets(file, spheres.radius.size());
  std::copy(spheres.box_lengths.begin(), spheres.box_lengths.end(), s.box_high.begin());
  s.node.assign(mesh.node.begin(), mesh.node.end());
  s.tet = std::move(mesh.tet);
  s.tet_grain = grain_of_tets(mesh.grain_tet_offset, s.tets(), one_line(path));
  if (file.has(packing::packing_relative_density))
    s.relative_density = file.read_scalar(packing::packing_relative_density);
  s.tet_fields = {{"grain", "1", {s.tet_grain.begin(), s.tet_grain.end()}}};
  return s;
}

} // namespace mpfem
