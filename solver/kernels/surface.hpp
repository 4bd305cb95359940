#pragma once
// Where a grain's surface is, and how large.

#include "solver/model/model.hpp"

namespace mpfem {

/// Bounding box of the grain's surface nodes at the current positions, mm.
Bounds surface_bounds(const Model& model, int grain);

/// Sum of the grain's facet areas, mm^2.
double surface_area(const Model& model, int grain);

} // namespace mpfem
