#include "solver/kernels/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/kernels/rows.hpp"

namespace mpfem {

MPFEM_FLATTEN Bounds update_surface(Model& model, int grain) {
  constexpr int W = native_lanes;
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data();
  double* normal = model.normal.data();
  const std::int32_t first = model.node_offset[g], end = first + model.surface_node_count[g];
  std::fill(normal + 4 * first, normal + 4 * end, 0.0);

  std::int32_t f = model.facet_offset[g];
  const std::int32_t facet_end = model.facet_offset[g + 1];
  for (; f < facet_end; f += W) {
    const int lanes = std::min(W, facet_end - f);
    std::int32_t corner[3][W];
    for (int i = 0; i < W; ++i)
      for (int c = 0; c < 3; ++c)
        corner[c][i] = model.facet[static_cast<std::size_t>(3 * std::min(f + i, facet_end - 1) + c)];
    Vector3<Pack<W>> edge[2];
    load_edges<W, 2>(position, corner, edge);
    const auto area = cross(edge[0], edge[1]);
    const auto third = Pack<W>(1.0 / 6.0) * area;
    for (const auto& nodes : corner) add_rows<W>(normal, nodes, lanes, third);
  }

  const double infinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::int32_t n = first; n < end; ++n) {
    double* row = normal + 4 * n;
    const double area = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    const double inverse = 1.0 / std::max(area, 1e-300);
    row[0] *= inverse, row[1] *= inverse, row[2] *= inverse;
    row[3] = area;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = position[4 * static_cast<std::size_t>(n) + axis];
      bounds.low[axis] = std::min(bounds.low[axis], x);
      bounds.high[axis] = std::max(bounds.high[axis], x);
    }
  }
  return bounds;
}

double surface_area(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  double area = 0;
  for (std::int32_t f = model.facet_offset[g]; f < model.facet_offset[g + 1]; ++f) {
    Vector3<double> x[3];
    for (int c = 0; c < 3; ++c) {
      const double* row =
          &model.position[4 * static_cast<std::size_t>(model.facet[static_cast<std::size_t>(3 * f + c)])];
      x[c] = {row[0], row[1], row[2]};
    }
    area += 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
  }
  return area;
}

} // namespace mpfem
