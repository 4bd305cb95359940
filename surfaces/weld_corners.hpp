#pragma once
// Loose triangles become a mesh: corners at the same place become one vertex.

#include <array>
#include <span>

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

/// Corners within `distance` > 0 (mm) of a vertex found before become that vertex, the nearest where there are several.
/// A vertex keeps the place of its first corner. `distance` is at least 1e-6 of the diagonal of the box around all
/// corners.
TriangleMesh weld_corners(std::span<const std::array<Vector3<double>, 3>> triangles, double distance);

} // namespace mpfem
