#pragma once
// Nodal normals and tributary areas of a grain's surface. They are found in packs, in every step: the functions stand
// in solver/kernels/surface.cpp. Here is what the model promises, so that it can use them without knowing the kernels.

#include "solver/model/model.hpp"

namespace mpfem {

/// Sets model.normal of the grain's surface nodes at the present positions: the sum of a third of each adjacent facet's
/// area vector gives the unit normal by its direction and the tributary area by its length. Returns the bounding box of
/// the surface, mm.
Bounds update_surface(Model& model, int grain);

/// Sum of the grain's facet areas, mm^2.
double surface_area(const Model& model, int grain);

} // namespace mpfem
