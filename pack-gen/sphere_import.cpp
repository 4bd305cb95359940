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

std::string body(const SpherePacking& packing, int index) {
  if (index < 0) return "the " + wall_name(-1 - index);
  const auto& c = packing.center[static_cast<std::size_t>(index)];
  return fmt::format("sphere {} at ({:g}, {:g}, {:g})", index, c[0], c[1], c[2]);
}

} // namespace

void refuse_overlap(const SpherePacking& packing, const std::string& name) {
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
    throw InputError(fmt::format("{}: {} and {} overlap by {:.4g} mm; allowed: no overlap", shown_path(name),
                                 body(packing, gap.first), body(packing, gap.second), -gap.gap));
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

} // namespace

SpherePacking import_spheres(CsvReader table, const std::optional<Point>& box) {
  SpherePacking packing = read_table(std::move(table));
  if (box) {
    packing.box = *box;
  } else {
    for (std::size_t k = 0; k < 3; ++k) {
      double low = packing.center[0][k] - packing.radius[0], high = packing.center[0][k] + packing.radius[0];
      for (std::size_t i = 1; i < packing.radius.size(); ++i) {
        low = std::min(low, packing.center[i][k] - packing.radius[i]);
        high = std::max(high, packing.center[i][k] + packing.radius[i]);
      }
      packing.box[k] = high - low;
      for (auto& center : packing.center) center[k] -= low;
    }
  }
  return packing;
}

SpherePacking import_spheres(const std::string& path, const std::optional<Point>& box) {
  return import_spheres(CsvReader::from_file(path), box);
}

SpherePacking import_spheres(const std::string& path, const CylinderInTable& cylinder) {
  SpherePacking packing = read_table(CsvReader::from_file(path));
  packing.shape = ContainerShape::cylinder;
  packing.box = {cylinder.diameter, cylinder.diameter, cylinder.height};
  const Point& bottom = cylinder.bottom_center;
  for (Point& center : packing.center) {
    center[0] += 0.5 * cylinder.diameter - bottom[0];
    center[1] += 0.5 * cylinder.diameter - bottom[1];
    center[2] -= bottom[2];
  }
  return packing;
}

SpherePacking import_spheres(const std::string& path, const PlacedSurface& surface) {
  SpherePacking packing = read_table(CsvReader::from_file(path));
  packing.shape = ContainerShape::surface;
  packing.surface = surface.container;
  packing.box = surface.lengths;
  for (Point& center : packing.center)
    for (std::size_t k = 0; k < 3; ++k) center[k] -= surface.corner_in_file[k];
  return packing;
}

} // namespace mpfem
