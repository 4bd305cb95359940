#pragma once
// Points and tetrahedra of a meshed packing as its file numbers them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/index.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// Point `i` of rows of three coordinates, mm.
inline Vector3<double> point(const std::vector<double>& rows, std::int32_t i) {
  return {rows[3 * at(i)], rows[3 * at(i) + 1], rows[3 * at(i) + 2]};
}

/// mm^3; negative where the tetrahedron is inverted.
inline double tet_volume(const MeshedPacking& packing, std::int32_t tet) {
  const std::int32_t* n = &packing.tet[4 * at(tet)];
  const auto x0 = point(packing.node, n[0]);
  return dot(point(packing.node, n[1]) - x0, cross(point(packing.node, n[2]) - x0, point(packing.node, n[3]) - x0)) /
         6.0;
}

} // namespace mpfem
