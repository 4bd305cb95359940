#include "solver/model/normals.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/rows.hpp"

namespace mpfem {

MPFEM_FLATTEN SurfaceNormals::SurfaceNormals(const Model& model, int grain)
    : first_(model.first_node(grain)),
      rows_(static_cast<std::size_t>(model.surface_node_count[static_cast<std::size_t>(grain)])) {
  if (rows_.empty()) return;
  constexpr int W = native_lanes;
  const auto g = static_cast<std::size_t>(grain);
  // Rows and numbers of nodes are counted from the grain's first.
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + model.first_row(grain);
  double* sums = &rows_.front().x;

  const std::int32_t facet_end = model.facet_offset[g + 1];
  for (std::int32_t f = model.facet_offset[g]; f < facet_end; f += W) {
    const int lanes = std::min(W, facet_end - f);
    std::int32_t corner[3][W];
    for (int i = 0; i < W; ++i)
      for (int c = 0; c < 3; ++c)
        corner[c][i] =
            model.facet[3 * static_cast<std::size_t>(std::min(f + i, facet_end - 1)) + static_cast<std::size_t>(c)] -
            first_node;
    Vector3<Pack<W>> edge[2];
    load_edges<W, 2>(position, corner, edge);
    const auto third = Pack<W>(1.0 / 6.0) * cross(edge[0], edge[1]); // of the facet's area
    for (const auto& nodes : corner) add_rows<W>(sums, nodes, lanes, third);
  }

  for (Row& row : rows_) {
    row.area = std::sqrt(row.x * row.x + row.y * row.y + row.z * row.z);
    const double inverse = 1.0 / std::max(row.area, 1e-300);
    row.x *= inverse, row.y *= inverse, row.z *= inverse;
  }
}

} // namespace mpfem
