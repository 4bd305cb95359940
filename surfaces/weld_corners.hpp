#pragma once
// Makes a mesh of separate triangles: corners at the same place become one vertex.

#include <array>
#include <span>

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

/// A corner within `distance` > 0 (mm) of earlier vertices becomes the nearest of them. A vertex keeps the place of its
/// first corner. `distance` must be at least 1e-6 of the diagonal of the box around all corners.
TriangleMesh weld_corners(std::span<const std::array<Vector3<double>, 3>> triangles, double distance);

} // namespace mpfem
