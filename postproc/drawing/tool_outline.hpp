#pragma once
// Where a plane cuts the bodies of rigid tools.

#include <array>
#include <vector>

#include "postproc/drawing/section.hpp"
#include "postproc/drawing/tool_body.hpp"

namespace mpfem {

/// A piece of the line along which a plane cuts a body, in coordinates as of SectionPolygon.
struct OutlinePiece {
  std::array<double, 2> from{}, to{}; ///< mm
};

/// All pieces of one body. A point is inside the body where a ray in any direction crosses an odd number of them. A cut
/// normal to the axis of a turned body gives circles of 360 pieces whose ends lie on the circle. A cut along the axis
/// gives its profile on both sides, with 16 pieces for each edge that the cut curves.
std::vector<OutlinePiece> section_outline(const ToolBody& body, const CutPlane& plane);

} // namespace mpfem
