#include "solver/model/model.hpp"

#include <numeric>

namespace mpfem {

double Model::total_reference_volume() const {
  return std::accumulate(reference_volume.begin(), reference_volume.end(), 0.0);
}

SurfaceView Model::surface() const {
  return {position, node_offset, surface_node_count, facet, facet_offset};
}

double PackedMesh::volume(std::int32_t file_tet) const {
  const auto n = corners(file_tet);
  const auto x0 = point(n[0]);
  return dot(point(n[1]) - x0, cross(point(n[2]) - x0, point(n[3]) - x0)) / 6.0;
}

PackedMesh MeshedPacking::mesh_of(int grain) const {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = grain_node_offset[g], first_tet = grain_tet_offset[g];
  const std::size_t nodes = static_cast<std::size_t>(grain_node_offset[g + 1] - first_node),
                    tets = static_cast<std::size_t>(grain_tet_offset[g + 1] - first_tet);
  const std::size_t node_from = ownership ? node_start[g] : static_cast<std::size_t>(first_node),
                    tet_from = ownership ? tet_start[g] : static_cast<std::size_t>(first_tet);
  return {std::span(node).subspan(3 * node_from, 3 * nodes), std::span(tet).subspan(4 * tet_from, 4 * tets), first_node,
          first_tet};
}

std::size_t Model::memory() const {
  const auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
  return bytes(position) + bytes(velocity) + bytes(force) + bytes(inverse_mass) + bytes(reference_area) +
         std::visit(bytes, blocks) + bytes(inverse_nodal_volume) + bytes(nodal_mean) + bytes(inverse_patch_volume) +
         bytes(inner_node) + bytes(inward) + bytes(mass_factor) + bytes(refinement) + bytes(facet) + bytes(file_node) +
         bytes(file_tet);
}

std::array<std::int32_t, 4> Model::nodes_of_tet(int grain, std::int32_t tet) const {
  return with_tet_numbers(*this, [&](auto number) {
    constexpr int lanes = TetBlock<decltype(number)>::lanes;
    const auto& node = block<decltype(number)>(block_offset[static_cast<std::size_t>(grain)] + tet / lanes).node;
    const int lane = tet % lanes;
    return std::array<std::int32_t, 4>{node[0][lane], node[1][lane], node[2][lane], node[3][lane]};
  });
}

} // namespace mpfem
