#pragma once
// Nodal normals and tributary areas of a grain's surface, computed in packs in every step.

#include "solver/model/model.hpp"

namespace mpfem {

/// Sets model.normal of the grain's surface nodes at the current positions, as set_normals() does
/// (solver/model/normals.hpp). Returns the bounding box of the surface, mm.
Bounds update_surface(Model& model, int grain);

/// Sum of the grain's facet areas, mm^2.
double surface_area(const Model& model, int grain);

} // namespace mpfem
