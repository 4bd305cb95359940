#include "solver/model/model.hpp"

#include <numeric>

namespace mpfem {

double Model::total_reference_volume() const {
  return std::accumulate(reference_volume.begin(), reference_volume.end(), 0.0);
}

SurfaceView Model::surface() const {
  return {position, node_offset, surface_node_count, facet, facet_offset};
}

std::size_t Model::memory() const {
  const auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
  return bytes(position) + bytes(velocity) + bytes(force) + bytes(normal) + bytes(inverse_mass) +
         bytes(reference_area) + std::visit(bytes, blocks) + bytes(inverse_nodal_volume) + bytes(nodal_mean) +
         bytes(inverse_patch_volume) + bytes(inner_node) + bytes(inward) + bytes(facet) + bytes(file_node) +
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
