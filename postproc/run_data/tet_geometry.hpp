#pragma once
// Centres and volumes of tetrahedra and grains in a snapshot.

#include <vector>

#include <Eigen/Core>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// Centre and volume of a tet.
struct TetGeometry {
  Eigen::Vector3d centre; ///< mm
  double volume;          ///< mm^3; negative where the tet is inverted
};

/// Geometry of the tet with this number.
TetGeometry tet_geometry(const Snapshot& snapshot, std::size_t tet);

/// [grains], centroids of all grains from their tets, mm.
std::vector<Eigen::Vector3d> grain_centres(const Snapshot& snapshot);

} // namespace mpfem
