#pragma once
// The message about a grain whose stresses can no longer be computed.

#include <string>

#include "solver/model/model.hpp"

namespace mpfem {

/// "tet 7 of grain 3 at (0.1, 0.2, 0.3) mm is inverted …; likely causes: …": the first inverted tet of the grain, or
/// that a stress is not finite.
std::string failed_grain_text(const Model& model, int grain);

} // namespace mpfem
