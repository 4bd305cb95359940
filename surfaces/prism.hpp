#pragma once
// The cross-section of a die given by triangles: what is between two heights must be a prism along z.

#include <array>
#include <optional>

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

/// Cross-section across z.
struct CrossSection {
  std::array<double, 2> low{}, high{}; ///< mm, its bounding rectangle (x, y)
  double area = 0;                     ///< mm^2
  double perimeter = 0;                ///< mm
};

/// The cross-section of a closed surface if it is the same from z = low to z = high (mm); nothing where a triangle
/// between them is tilted by more than 0.001 out of the direction z, or where the surface does not reach from low to
/// high.
std::optional<CrossSection> section_of_prism(const TriangleMesh& mesh, double low, double high);

} // namespace mpfem
