#include "results-schema/packing_file.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"

namespace mpfem::schema {

namespace {

/// A dataset of a file, for messages.
struct Place {
  const FileReader& file;
  std::string_view dataset;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: dataset {}: {}", one_line(file.path()), dataset, what));
  }
};

void refuse_not_positive(const std::vector<double>& values, const Place& place) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0) || !std::isfinite(values[i]))
      place.fail(fmt::format("found {:g} at index {}, allowed: finite and > 0", values[i], i));
}

void refuse_not_finite(const std::vector<double>& points, const Place& place) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i]))
      place.fail(fmt::format("found {:g} at index [{}, {}], allowed: finite", points[i], i / 3, i % 3));
}

/// Centres may lie on a wall (those of hemispheres do), to within rounding.
void refuse_outside(const std::vector<double>& center, const std::vector<double>& lengths, const Place& place) {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < center.size(); ++i) {
    const double length = lengths[i % 3];
    if (center[i] < -rounding * length || center[i] > (1 + rounding) * length)
      place.fail(
          fmt::format("found {:g} at index [{}, {}], allowed: 0 … {:g}, in the box", center[i], i / 3, i % 3, length));
  }
}

/// A box where the file names no shape.
ContainerShape read_shape(const FileReader& file) {
  if (!file.has(packing::box_shape)) return ContainerShape::box;
  const std::string name = file.read_scalar(packing::box_shape);
  for (const ContainerShape shape : {ContainerShape::box, ContainerShape::cylinder, ContainerShape::surface})
    if (name == name_of(shape)) return shape;
  Place{file, packing::box_shape.path}.fail(
      fmt::format("found '{}', allowed: {}", one_line(name), fmt::join(container_names, ", ")));
}

/// The bounding box of a cylinder must be as wide as it is deep.
void refuse_oval(const std::vector<double>& lengths, const Place& place) {
  constexpr double rounding = 1e-9;
  if (!(std::abs(lengths[0] - lengths[1]) <= rounding * lengths[0]))
    place.fail(fmt::format("found {:g} and {:g} at index 0 and 1, allowed: the same, the diameter of the cylinder",
                           lengths[0], lengths[1]));
}

/// As refuse_outside, for the round wall.
void refuse_outside_circle(const std::vector<double>& center, double diameter, const Place& place) {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i + 2 < center.size(); i += 3) {
    const double from_axis = std::hypot(center[i] - 0.5 * diameter, center[i + 1] - 0.5 * diameter);
    if (from_axis > (0.5 + rounding) * diameter)
      place.fail(fmt::format("found a distance of {:g} from the axis at index {}, allowed: 0 … {:g}, in the cylinder",
                             from_axis, i / 3, 0.5 * diameter));
  }
}

/// Offsets must rise from 0 to `end`, with at least one row for each grain.
void refuse_wrong_offsets(const std::vector<std::int32_t>& offset, std::size_t spheres, std::size_t end,
                          const Place& place) {
  if (offset.size() != spheres + 1)
    place.fail(
        fmt::format("found {} values, allowed: {}, one more than there are spheres", offset.size(), spheres + 1));
  const auto expected = [&](std::size_t i, const std::string& allowed) {
    place.fail(fmt::format("found {} at index {}, allowed: {}", offset[i], i, allowed));
  };
  if (offset.front() != 0) expected(0, "0");
  for (std::size_t i = 1; i < offset.size(); ++i)
    if (offset[i] <= offset[i - 1]) expected(i, fmt::format("more than the {} before it", offset[i - 1]));
  if (static_cast<std::size_t>(offset.back()) != end) expected(spheres, fmt::format("{}, the number of rows", end));
}

void refuse_foreign_nodes(const PackingTets& mesh, const Place& place) {
  for (std::size_t g = 0; g + 1 < mesh.grain_node_offset.size(); ++g) {
    const std::int32_t first = mesh.grain_node_offset[g], end = mesh.grain_node_offset[g + 1];
    for (auto k = 4 * static_cast<std::size_t>(mesh.grain_tet_offset[g]);
         k < 4 * static_cast<std::size_t>(mesh.grain_tet_offset[g + 1]); ++k)
      if (mesh.tet[k] < first || mesh.tet[k] >= end)
        place.fail(fmt::format("found node {} at index [{}, {}], allowed: {} … {}, the nodes of grain {}", mesh.tet[k],
                               k / 4, k % 4, first, end - 1, g));
  }
}

} // namespace

PackingSpheres read_packing_spheres(const FileReader& file) {
  PackingSpheres spheres{file.read(packing::box_lengths), file.read(packing::spheres_center),
                         file.read(packing::spheres_radius), read_shape(file)};
  const auto at = [&](const DatasetDescription& dataset) { return Place{file, dataset.path}; };
  refuse_not_positive(spheres.box_lengths, at(packing::box_lengths));
  if (spheres.radius.empty()) at(packing::spheres_radius).fail("found no sphere, allowed: at least one");
  if (spheres.center.size() != 3 * spheres.radius.size())
    at(packing::spheres_center)
        .fail(fmt::format("found {} centres, allowed: {}, as many as radii", spheres.center.size() / 3,
                          spheres.radius.size()));
  refuse_not_positive(spheres.radius, at(packing::spheres_radius));
  refuse_not_finite(spheres.center, at(packing::spheres_center));
  refuse_outside(spheres.center, spheres.box_lengths, at(packing::spheres_center));
  if (spheres.shape == ContainerShape::cylinder) {
    refuse_oval(spheres.box_lengths, at(packing::box_lengths));
    refuse_outside_circle(spheres.center, spheres.box_lengths[0], at(packing::spheres_center));
  }
  return spheres;
}

PackingOffsets read_packing_offsets(const FileReader& file, std::size_t spheres) {
  PackingOffsets offsets{file.read(packing::mesh_grain_node_offset), file.read(packing::mesh_grain_tet_offset)};
  refuse_wrong_offsets(offsets.node, spheres, file.rows(packing::mesh_node),
                       {file, packing::mesh_grain_node_offset.path});
  refuse_wrong_offsets(offsets.tet, spheres, file.rows(packing::mesh_tet), {file, packing::mesh_grain_tet_offset.path});
  return offsets;
}

PackingTets read_packing_tets(const FileReader& file, std::size_t spheres) {
  PackingTets mesh{file.read(packing::mesh_node), file.read(packing::mesh_tet), {}, {}};
  const auto at = [&](const DatasetDescription& dataset) { return Place{file, dataset.path}; };
  refuse_not_finite(mesh.node, at(packing::mesh_node));
  PackingOffsets offsets = read_packing_offsets(file, spheres);
  mesh.grain_node_offset = std::move(offsets.node);
  mesh.grain_tet_offset = std::move(offsets.tet);
  refuse_foreign_nodes(mesh, at(packing::mesh_tet));
  return mesh;
}

std::uint64_t hash_of_mesh(std::uint64_t of_nodes_and_tets, std::span<const std::int32_t> grain_node_offset,
                           std::span<const double> box_lengths) {
  return hash_values(box_lengths, hash_values(grain_node_offset, of_nodes_and_tets));
}

} // namespace mpfem::schema
