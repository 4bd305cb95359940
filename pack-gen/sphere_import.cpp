#include "pack-gen/sphere_import.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/physical_ranges.hpp"
#include "pack-gen/csv_table.hpp"
#include "pack-gen/sphere_tree.hpp"

namespace mpfem {

namespace {

std::string body(const SpherePacking& packing, int index, const Point& corner) {
  if (index < 0) return "the " + wall_name(-1 - index);
  const auto& c = packing.center[static_cast<std::size_t>(index)];
  return fmt::format("sphere {} at ({:g}, {:g}, {:g})", index, c[0] + corner[0], c[1] + corner[1], c[2] + corner[2]);
}

/// Box around all spheres; there is at least one.
Bounds bounds_of(const SpherePacking& packing) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::size_t i = 0; i < packing.radius.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      bounds.low[k] = std::min(bounds.low[k], packing.center[i][k] - packing.radius[i]);
      bounds.high[k] = std::max(bounds.high[k], packing.center[i][k] + packing.radius[i]);
    }
  return bounds;
}

/// An overlap of two spheres or a wall by more than the rounding of the numbers, as which touching spheres overlap.
std::optional<SphereGap> overlap_of(const SpherePacking& packing) {
  double largest = 0;
  for (std::size_t i = 0; i < packing.radius.size(); ++i) {
    largest = std::max(largest, packing.radius[i]);
    for (const double coordinate : packing.center[i]) largest = std::max(largest, std::abs(coordinate));
  }
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * largest;
  SphereGap gap = smallest_wall_gap(packing);
  if (!(gap.gap < -rounding)) gap = smallest_gap_of_pairs(packing.center, packing.radius, -rounding);
  if (gap.gap < -rounding) return gap;
  return {};
}

[[noreturn]] void refuse(const SphereGap& overlap, const ImportedSpheres& spheres, const std::string& name,
                         const std::string& more) {
  const auto shown = [&](int index) { return body(spheres.packing, index, spheres.corner_in_table); };
  throw InputError(fmt::format("{}: {} and {} overlap by {:.4g} mm, allowed: no overlap{}", shown_path(name),
                               shown(overlap.first), shown(overlap.second), -overlap.gap, more));
}

std::string surface_beside_spheres(const ImportedSpheres& spheres) {
  return size_beside(*spheres.surface_size, "the spheres", lengths_of(bounds_of(spheres.packing)));
}

} // namespace

void refuse_overlap(const SpherePacking& packing, const std::string& name) {
  if (const auto overlap = overlap_of(packing)) refuse(*overlap, {packing}, name, "");
}

void refuse_overlap(const ImportedSpheres& spheres, const std::string& name) {
  const auto overlap = overlap_of(spheres.packing);
  if (!overlap) return;
  const bool at_surface = spheres.surface_size && std::min(overlap->first, overlap->second) < 0;
  refuse(*overlap, spheres, name, at_surface ? "; " + surface_beside_spheres(spheres) : "");
}

std::string implausible_surface(const ImportedSpheres& spheres) {
  if (!spheres.surface_size) return {};
  const Point lengths = lengths_of(bounds_of(spheres.packing));
  return mean_ratio(*spheres.surface_size, lengths) > unlikely_ratio ? surface_beside_spheres(spheres) : "";
}

namespace {

/// Spheres as the table has them, in no container.
SpherePacking read_table(CsvReader table) {
  SpherePacking packing;
  for (const auto& row : read_csv(
           std::move(table), {{"x", any_length}, {"y", any_length}, {"z", any_length}, {"radius", positive_length}})) {
    packing.center.push_back({row[0], row[1], row[2]});
    packing.radius.push_back(row[3]);
  }
  return packing;
}

/// Moves the spheres so that their box begins at the origin.
ImportedSpheres moved_to_origin(SpherePacking packing, const Point& corner) {
  for (Point& center : packing.center)
    for (std::size_t k = 0; k < 3; ++k) center[k] -= corner[k];
  return {.packing = std::move(packing), .corner_in_table = corner};
}

} // namespace

ImportedSpheres import_spheres(CsvReader table, const std::optional<Point>& box) {
  SpherePacking packing = read_table(std::move(table));
  if (box) {
    packing.box = *box;
    return {.packing = std::move(packing)};
  }
  const Bounds bounds = bounds_of(packing);
  packing.box = lengths_of(bounds);
  return moved_to_origin(std::move(packing), bounds.low);
}

ImportedSpheres import_spheres(const std::string& path, const std::optional<Point>& box) {
  return import_spheres(CsvReader::from_file(path), box);
}

ImportedSpheres import_spheres(const std::string& path, const CylinderInTable& cylinder) {
  SpherePacking packing = read_table(CsvReader::from_file(path));
  packing.shape = ContainerShape::cylinder;
  packing.box = {cylinder.diameter, cylinder.diameter, cylinder.height};
  const Point& bottom = cylinder.bottom_center;
  const double radius = 0.5 * cylinder.diameter;
  return moved_to_origin(std::move(packing), {bottom[0] - radius, bottom[1] - radius, bottom[2]});
}

ImportedSpheres import_spheres(const std::string& path, const PlacedSurface& surface) {
  SpherePacking packing = read_table(CsvReader::from_file(path));
  packing.shape = ContainerShape::surface;
  packing.surface = surface.container;
  packing.box = surface.lengths;
  ImportedSpheres spheres = moved_to_origin(std::move(packing), surface.corner_in_file);
  spheres.surface_size = surface.size;
  return spheres;
}

} // namespace mpfem
