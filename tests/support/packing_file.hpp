#pragma once
// Meshed packing files for tests, without a mesher.

#include <algorithm>
#include <string>
#include <vector>

#include "results-schema/file.hpp"
#include "tests/support/meshes.hpp"

namespace mpfem::test {

/// Writes a meshed packing as pack-gen would; sphere radii (mm) as given, centres at the grains' mean node. Offsets may
/// be wrong.
inline void write_packing(const std::string& path, const MeshedPacking& packing, const std::vector<double>& radius) {
  namespace file = schema::packing;
  using Doubles = std::span<const double>;
  using Integers = std::span<const std::int32_t>;
  const std::size_t grains = radius.size();
  std::vector<double> center(3 * grains, 0.0);
  for (std::size_t g = 0; g < grains; ++g) {
    const auto first = static_cast<std::size_t>(packing.grain_node_offset[g]),
               last = static_cast<std::size_t>(packing.grain_node_offset[g + 1]);
    for (std::size_t n = first; n < std::min(last, packing.node.size() / 3); ++n)
      for (std::size_t a = 0; a < 3; ++a)
        center[3 * g + a] += packing.node[3 * n + a] / static_cast<double>(last - first);
  }
  schema::FileWriter writer(path, schema::FileKind::packing, "mpfem tests");
  writer.write(file::box_lengths, Doubles(packing.box_lengths), 3);
  writer.write(file::spheres_center, Doubles(center), grains);
  writer.write(file::spheres_radius, Doubles(radius), grains);
  writer.write(file::mesh_node, Doubles(packing.node), packing.node.size() / 3);
  writer.write(file::mesh_tet, Integers(packing.tet), packing.tet.size() / 4);
  writer.write(file::mesh_grain_node_offset, Integers(packing.grain_node_offset), packing.grain_node_offset.size());
  writer.write(file::mesh_grain_tet_offset, Integers(packing.grain_tet_offset), packing.grain_tet_offset.size());
  writer.commit();
}

/// Eight grains of radius 0.1 mm at the corners of a cube, each meshed with n cells along its diameter: touches its
/// neighbours and the walls once compacted a little.
inline MeshedPacking eight_grains(int n) {
  std::vector<GrainMesh> grains;
  for (int i = 0; i < 8; ++i) {
    grains.push_back(ball_mesh(n, 0.1));
    rotate(grains.back(), {0.6, 0, 0.8}, 0.4 * i);
    // A little off the lattice, so that nothing is symmetric.
    const auto corner = [i](int bit) { return (i >> bit & 1) == 0 ? 0.105 : 0.315; };
    move(grains.back(),
         {corner(0) + 0.002 * (i % 3 - 1), corner(1) + 0.002 * ((i + 1) % 3 - 1), corner(2) + 0.001 * (i % 2)});
  }
  return pack(grains, {0.42, 0.42, 0.42});
}

} // namespace mpfem::test
