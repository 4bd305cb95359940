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

} // namespace

void refuse_overlap(const SpherePacking& packing, const std::string& name, const Point& corner) {
  // Touching spheres overlap by the rounding of the numbers.
  double largest = 0;
  for (std::size_t i = 0; i < packing.radius.size(); ++i) {
    largest = std::max(largest, packing.radius[i]);
    for (const double coordinate : packing.center[i]) largest = std::max(largest, std::abs(coordinate));
  }
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * largest;
  SphereGap gap = smallest_wall_gap(packing);
  if (!(gap.gap < -rounding)) gap = smallest_gap_of_pairs(packing.center, packing.radius, -rounding);
  if (gap.gap < -rounding)
    throw InputError(fmt::format("{}: {} and {} overlap by {:.4g} mm, allowed: no overlap", shown_path(name),
                                 body(packing, gap.first, corner), body(packing, gap.second, corner), -gap.gap));
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
  return {std::move(packing), corner};
}

} // namespace

ImportedSpheres import_spheres(CsvReader table, const std::optional<Point>& box) {
  SpherePacking packing = read_table(std::move(table));
  Point corner{};
  if (box) {
    packing.box = *box;
    return {std::move(packing), corner};
  }
  for (std::size_t k = 0; k < 3; ++k) {
    double low = packing.center[0][k] - packing.radius[0], high = packing.center[0][k] + packing.radius[0];
    for (std::size_t i = 1; i < packing.radius.size(); ++i) {
      low = std::min(low, packing.center[i][k] - packing.radius[i]);
      high = std::max(high, packing.center[i][k] + packing.radius[i]);
    }
    packing.box[k] = high - low;
    corner[k] = low;
  }
  return moved_to_origin(std::move(packing), corner);
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
  return moved_to_origin(std::move(packing), surface.corner_in_file);
}

} // namespace mpfem
