#pragma once
// Spheres from a table, and the check that they do not overlap.

#include <optional>
#include <string>

#include "common/csv_reader.hpp"
#include "pack-gen/packing.hpp"

namespace mpfem {

/// Throws InputError, naming the spheres and the overlap, if two spheres or a sphere and a wall overlap by more than
/// the rounding of their numbers. Ends at the first overlap of two spheres.
void refuse_overlap(const SpherePacking& packing, const std::string& name);

/// Spheres of a CSV table with the columns x, y, z, radius (mm). Without a box: the tightest around all spheres.
/// Spheres are moved so that the box begins at the origin. Throws InputError.
SpherePacking import_spheres(const std::string& path, const std::optional<Point>& box);
/// The same for a table that is already open.
SpherePacking import_spheres(CsvReader table, const std::optional<Point>& box);

/// A cylinder about z, and where the centre of its bottom is in a table of spheres.
struct CylinderInTable {
  double diameter = 0, height = 0; ///< mm
  Point bottom_center{};           ///< mm
};

/// The same into a cylinder: spheres are moved so that the box that bounds it begins at the origin. refuse_overlap
/// checks whether they are inside it. Throws InputError.
SpherePacking import_spheres(const std::string& path, const CylinderInTable& cylinder);

/// The same into a surface, whose coordinates in its file are those of the table.
SpherePacking import_spheres(const std::string& path, const PlacedSurface& surface);

} // namespace mpfem
