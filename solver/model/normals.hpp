#pragma once
// Nodal normals and tributary areas of a grain's surface, computed in packs: while a model is built and in every step.

#include "solver/model/model.hpp"

namespace mpfem {

/// Sets model.normal of the grain's surface nodes at the current positions: the sum of a third of each adjacent facet's
/// area vector gives the unit normal by its direction and the tributary area (mm^2) by its length.
void set_normals(Model& model, int grain);

} // namespace mpfem
