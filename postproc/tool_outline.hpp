#pragma once
// Where a plane cuts the bodies of rigid tools.

#include <array>
#include <vector>

#include "postproc/section.hpp"
#include "postproc/tool_body.hpp"

namespace mpfem {

/// A piece of the line along which a plane cuts a body, in the plane's own coordinates, as SectionPolygon.
struct OutlinePiece {
  std::array<double, 2> from{}, to{}; ///< mm
};

/// All pieces of one body: a point lies in its matter where a ray to any side crosses an odd number of them. Across the
/// axis of a turned body they are circles of 360 pieces, whose ends lie on the circle; along it its profile twice, with
/// 16 pieces for each edge that the cut bends.
std::vector<OutlinePiece> section_outline(const ToolBody& body, const CutPlane& plane);

} // namespace mpfem
