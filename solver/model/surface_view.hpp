#pragma once
// The surfaces of all grains, without everything else that a model holds.

#include <array>
#include <cstdint>
#include <span>

#include "common/bounds.hpp"

namespace mpfem {

/// Nodes are rows of four doubles (x, y, z, unused) in mm. The surface nodes of a grain are its first nodes.
struct SurfaceView {
  std::span<const double> position;                 ///< [nodes * 4], mm
  std::span<const std::int32_t> node_offset;        ///< [grains + 1]
  std::span<const std::int32_t> surface_node_count; ///< [grains]: nodes node_offset[g] … + count are on the surface
  std::span<const std::int32_t> facet;              ///< [facets * 3], node indices, outward counter-clockwise
  std::span<const std::int32_t> facet_offset;       ///< [grains + 1]
};

} // namespace mpfem
