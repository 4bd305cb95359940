#pragma once
// What a step needs of a grain's surface: its normals and where it is.

#include "solver/model/model.hpp"

namespace mpfem {

/// Sets model.normal of the grain's surface nodes at the current positions (solver/model/normals.hpp). Returns the
/// bounding box of the surface, mm.
Bounds update_surface(Model& model, int grain);

/// Sum of the grain's facet areas, mm^2.
double surface_area(const Model& model, int grain);

} // namespace mpfem
