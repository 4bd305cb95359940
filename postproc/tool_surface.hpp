#pragma once
// The surfaces of rigid tools as triangles, for pictures, pages and VTK.

#include <vector>

#include "postproc/picture/cut_solid.hpp"
#include "postproc/tool_body.hpp"

namespace mpfem {

/// Turned bodies and slabs as tets, without fields; `tet_grain` is the body's index. Circles have 120 corners.
Snapshot tool_tets(const std::vector<ToolBody>& bodies);

/// What is left of the bodies, within the extent and half of its thickness more; `grain` is the body's index. Turned
/// bodies and slabs are closed where they are cut, others are shells.
std::vector<SolidTriangle> tool_surface(const std::vector<ToolBody>& bodies, const DrawnExtent& extent,
                                        const CutAway& away);

} // namespace mpfem
