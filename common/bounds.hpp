#pragma once
// An axis-aligned box in space.

#include <array>

namespace mpfem {

/// Axis-aligned bounding box, mm.
struct Bounds {
  std::array<double, 3> low;
  std::array<double, 3> high;
};

} // namespace mpfem
