#include "solver/kernels/surface.hpp"

#include <algorithm>
#include <limits>

#include "solver/kernels/contact_facet.hpp"

namespace mpfem {

Bounds surface_bounds(const Model& model, int grain) {
  const std::size_t first = model.first_node(grain),
                    end = first + static_cast<std::size_t>(model.surface_node_count[static_cast<std::size_t>(grain)]);
  const double infinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::size_t n = first; n < end; ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = model.position[4 * n + axis];
      bounds.low[axis] = std::min(bounds.low[axis], x);
      bounds.high[axis] = std::max(bounds.high[axis], x);
    }
  return bounds;
}

double surface_area(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  double area = 0;
  for (std::int32_t f = model.facet_offset[g]; f < model.facet_offset[g + 1]; ++f)
    area += 0.5 * norm(facet_direction(facet_geometry(model, f).x));
  return area;
}

} // namespace mpfem
