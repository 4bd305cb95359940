#pragma once
// Spheres from a table, and the check that they do not overlap.

#include <optional>
#include <string>

#include "common/csv_reader.hpp"
#include "pack-gen/packing.hpp"

namespace mpfem {

/// Spheres of a table, moved so that the box around their container begins at the origin.
struct ImportedSpheres {
  SpherePacking packing;
  Point corner_in_table{};               ///< mm, where that box begins in the table
  std::optional<StlSize> surface_size{}; ///< of a surface, for messages
};

/// Throws InputError, naming the spheres and the overlap, if two spheres or a sphere and a wall overlap by more than
/// the rounding of their numbers. Ends at the first overlap of two spheres.
void refuse_overlap(const SpherePacking& packing, const std::string& name);
/// The same with the coordinates of the table, and with the size of a surface that a sphere reaches through.
void refuse_overlap(const ImportedSpheres& spheres, const std::string& name);
/// One line if the surface is so large beside the spheres that its scale is probably wrong; else empty.
std::string implausible_surface(const ImportedSpheres& spheres);

/// Spheres of a CSV table with the columns x, y, z, radius (mm). Without a box: the tightest around all spheres.
/// Throws InputError.
ImportedSpheres import_spheres(const std::string& path, const std::optional<Point>& box);
/// The same for a table that is already open.
ImportedSpheres import_spheres(CsvReader table, const std::optional<Point>& box);

/// A cylinder about z, and where the centre of its bottom is in a table of spheres.
struct CylinderInTable {
  double diameter = 0, height = 0; ///< mm
  Point bottom_center{};           ///< mm
};

/// The same into a cylinder; refuse_overlap checks whether they are inside it. Throws InputError.
ImportedSpheres import_spheres(const std::string& path, const CylinderInTable& cylinder);

/// The same into a surface, whose coordinates in its file are those of the table.
ImportedSpheres import_spheres(const std::string& path, const PlacedSurface& surface);

} // namespace mpfem
