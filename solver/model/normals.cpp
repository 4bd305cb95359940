#include "solver/model/normals.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/rows.hpp"

namespace mpfem {

MPFEM_FLATTEN void set_normals(Model& model, int grain) {
  constexpr int W = native_lanes;
  const auto g = static_cast<std::size_t>(grain);
  // Rows and numbers of nodes are counted from the grain's first.
  const std::int32_t first_node = model.node_offset[g], nodes_on_surface = model.surface_node_count[g];
  const double* position = model.position.data() + model.first_row(grain);
  double* normal = model.normal.data() + model.first_row(grain);
  std::fill_n(normal, 4 * nodes_on_surface, 0.0);

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
    for (const auto& nodes : corner) add_rows<W>(normal, nodes, lanes, third);
  }

  for (std::int32_t n = 0; n < nodes_on_surface; ++n) {
    double* row = normal + 4 * n;
    const double area = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    const double inverse = 1.0 / std::max(area, 1e-300);
    row[0] *= inverse, row[1] *= inverse, row[2] *= inverse;
    row[3] = area;
  }
}

} // namespace mpfem
