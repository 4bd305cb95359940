#pragma once
// Nodal normals and tributary areas of a grain's surface.

#include <array>

#include "solver/model/model.hpp"

namespace mpfem {

/// Axis-aligned bounding box of a grain's surface, mm.
struct Bounds {
  std::array<double, 3> low;
  std::array<double, 3> high;
};

/// Sets model.normal of the grain's surface nodes at the present positions: the sum of a third of each adjacent facet's
/// area vector gives the unit normal by its direction and the tributary area by its length.
Bounds update_surface(Model& model, int grain);

/// Sum of the grain's facet areas, mm^2.
double surface_area(const Model& model, int grain);

} // namespace mpfem
