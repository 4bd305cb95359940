#pragma once
// The surfaces of rigid tools as triangles, for pictures, pages and VTK.

#include <vector>

#include "postproc/drawing/cut_solid.hpp"
#include "postproc/drawing/tool_body.hpp"

namespace mpfem {

/// Turned bodies and slabs as tets, without fields; `tet_grain` is the body's index. Circles have 120 corners.
Snapshot tool_tets(const std::vector<ToolBody>& bodies);

/// The surfaces of the bodies after cutting, within the extent plus half of its thickness; `grain` is the body's index.
/// Turned bodies and slabs are closed at the cuts, others are open shells.
std::vector<SolidTriangle> tool_surface(const std::vector<ToolBody>& bodies, const DrawnExtent& extent,
                                        const CutAway& away);

} // namespace mpfem
