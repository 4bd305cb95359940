#pragma once
// Requirements on a packing file beyond the schema, for every program that reads one.

#include <cstdint>
#include <span>
#include <vector>

#include "results-schema/container.hpp"
#include "results-schema/file.hpp"

namespace mpfem::schema {

/// The spheres of a packing, and their container.
struct PackingSpheres {
  std::vector<double> box_lengths; ///< [3], mm, > 0; for a cylinder diameter, diameter, height
  std::vector<double> center;      ///< [spheres][3], mm, in the container
  std::vector<double> radius;      ///< [spheres], mm, > 0; at least one
  ContainerShape shape = ContainerShape::box;
};

/// The meshes of all grains, one after another.
struct PackingTets {
  std::vector<double> node;                                      ///< [nodes][3], mm
  std::vector<std::int32_t> tet;                                 ///< [tets][4]; a grain's tets have its own nodes
  std::vector<std::int32_t> grain_node_offset, grain_tet_offset; ///< [spheres + 1]; every grain has nodes and tets
};

/// Where the nodes and tets of each grain begin, and the end.
struct PackingOffsets {
  std::vector<std::int32_t> node, tet; ///< [spheres + 1]; every grain has nodes and tets
};

/// Reads the spheres of a packing file. Throws InputError "FILE: dataset /x …" with index, what was found and what is
/// allowed.
PackingSpheres read_packing_spheres(const FileReader& file);

/// Reads where the nodes and tets of each grain begin, in a packing file with this number of spheres and with
/// /mesh/tet. Throws InputError in the same form.
PackingOffsets read_packing_offsets(const FileReader& file, std::size_t spheres);

/// Reads the meshes of a packing file with this number of spheres and with /mesh/tet. Throws InputError in the same
/// form.
PackingTets read_packing_tets(const FileReader& file, std::size_t spheres);

/// Identifies a mesh, as runs keep it (/provenance/packing_hash). `of_nodes_and_tets`: hash of its nodes, with that of
/// its tets chained to it (common/hash.hpp).
std::uint64_t hash_of_mesh(std::uint64_t of_nodes_and_tets, std::span<const std::int32_t> grain_node_offset,
                           std::span<const double> box_lengths);

} // namespace mpfem::schema
