#include "solver/model/normals.hpp"

#include <algorithm>
#include <cmath>

#include "solver/physics/pack.hpp"

namespace mpfem {

namespace {

constexpr int group = native_lanes;

/// A third of the area vectors (mm^2) of up to one group of facets, in packs as in the kernels: plain numbers would be
/// rounded differently.
Vector3<Pack<group>> thirds_of_areas(const Model& model, const std::int32_t* facet, int facets) {
  Vector3<Pack<group>> x[3];
  for (int i = 0; i < group; ++i)
    for (int c = 0; c < 3; ++c) {
      const double* row = &model.position[4 * static_cast<std::size_t>(facet[3 * std::min(i, facets - 1) + c])];
      x[c].x.v[i] = row[0], x[c].y.v[i] = row[1], x[c].z.v[i] = row[2];
    }
  return Pack<group>(1.0 / 6.0) * cross(x[1] - x[0], x[2] - x[0]);
}

} // namespace

void set_normals(Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(model.node_offset[g]);
  const auto end = first + static_cast<std::size_t>(model.surface_node_count[g]);
  std::fill(model.normal.data() + 4 * first, model.normal.data() + 4 * end, 0.0);

  const std::int32_t end_facet = model.facet_offset[g + 1];
  for (std::int32_t f = model.facet_offset[g]; f < end_facet; f += group) {
    const int facets = std::min(group, end_facet - f);
    const std::int32_t* facet = model.facet.data() + 3 * static_cast<std::size_t>(f);
    const Vector3<Pack<group>> third = thirds_of_areas(model, facet, facets);
    // In the order in which the kernels add them.
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < facets; ++i) {
        double* row = &model.normal[4 * static_cast<std::size_t>(facet[3 * i + c])];
        row[0] += third.x.v[i], row[1] += third.y.v[i], row[2] += third.z.v[i];
      }
  }

  for (std::size_t n = first; n < end; ++n) {
    double* row = &model.normal[4 * n];
    const double area = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    const double inverse = 1.0 / std::max(area, 1e-300);
    row[0] *= inverse, row[1] *= inverse, row[2] *= inverse;
    row[3] = area;
  }
}

} // namespace mpfem
