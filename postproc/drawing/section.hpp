#pragma once
// Plane sections through the tetrahedra.

#include <array>
#include <vector>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// A plane normal to a coordinate axis (0, 1, 2) at `position` (mm).
struct CutPlane {
  int axis = 2;
  double position = 0;
};

/// A triangle or quadrilateral in the plane, in the plane's own coordinates: the two other axes in cyclic order (for z:
/// x and y).
struct SectionPolygon {
  int corners = 0;
  std::array<std::array<double, 2>, 4> corner{}; ///< mm, convex, in either sense of rotation
  std::int32_t tet = 0;
};

/// The sections of all tets that the plane cuts. A node exactly in the plane counts as above it.
std::vector<SectionPolygon> cut(const Snapshot& snapshot, const CutPlane& plane);

/// The same, but throws InputError where the plane cuts no grain.
std::vector<SectionPolygon> cut_grains(const Snapshot& snapshot, const CutPlane& plane);

/// Area of a polygon (mm^2).
double area(const SectionPolygon& polygon);

} // namespace mpfem
