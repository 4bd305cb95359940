#pragma once
// Sphere packings and their meshes in files.

#include <cstdint>
#include <optional>
#include <string>

#include "pack-gen/grain_mesh.hpp"
#include "pack-gen/packing.hpp"
#include "pack-gen/size_distribution.hpp"

namespace mpfem {

/// What a packing file contains besides spheres and mesh.
struct PackingOrigin {
  std::optional<std::int64_t> seed;
  std::string description; ///< text of the description, or the source of an import
  std::vector<double> target_diameter, target_cumulative_number; ///< the wanted distribution, empty if there is none
};

/// The spheres of a packing file, and where they come from.
struct SphereFile {
  SpherePacking packing;
  PackingOrigin origin;
};

/// The wanted distribution as a curve of 101 points between its smallest and largest size.
void tabulate_target(const SizeDistribution& distribution, double scale, PackingOrigin& origin);

/// Reads spheres (meshed or not). Throws InputError.
SphereFile read_spheres(const std::string& path);
/// Writes x, y, z, radius with units in the heading.
void export_spheres(const std::string& path, const SpherePacking& packing);

/// A mesh and its measured properties.
struct MeshForFile {
  const PackingMesh* mesh = nullptr;
  double nominal_size = 0, smallest_facet_gap = 0, smallest_quality = 0;
  bool hemispheres =
      false; ///< grains are halves of the spheres: half their density, and no gap to the walls that cut them
};

/// Writes spheres, and the mesh if there is one. Throws StorageError.
void write_packing_file(const std::string& path, const SpherePacking& packing, const PackingOrigin& origin,
                        const std::optional<MeshForFile>& mesh = {});

/// A mesh as a packing file has it.
struct MeshFromFile {
  PackingMesh mesh;
  double nominal_size = 0; ///< mm
};
/// Reads the mesh of a packing file. Throws InputError if there is none.
MeshFromFile read_mesh(const std::string& path);

} // namespace mpfem
