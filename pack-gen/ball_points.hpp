#pragma once
// Points from which a ball of unit radius is meshed, with no poles and no seam.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "pack-gen/tet_mesh.hpp"

namespace mpfem {

/// Delaunay tetrahedra of points, with positive volume, in an order that depends only on the points.
using Tetrahedralize = std::function<std::vector<Tet>(const std::vector<Point>&)>;

/// How a ball's points are laid out.
struct BallLayout {
  double edge = 0.2;          ///< edge length on the surface, in radii
  double interior_edge = 1.0; ///< interior edge length over that on the surface
  double skin = 0.75;         ///< depth of the first interior points, in edge lengths
  int smoothing = 10;         ///< rounds of smoothing
  std::uint64_t seed = 1;     ///< orientation and offset of the interior lattice
};

/// A smoothed ball: surface nodes first, at radius 1 exactly.
struct BallMesh {
  TetMesh mesh;
  std::size_t surface_nodes = 0;
};

/// Lays out points: a Fibonacci spiral on the sphere; inside, a body-centred cubic lattice, whose Delaunay tetrahedra
/// are all alike and nearly regular. Then alternates Delaunay with smoothing: interior nodes go to the volume-weighted
/// mean of the circumcentres around them (optimal Delaunay triangulation, Chen & Xu 2004), surface nodes to the
/// area-weighted mean of their facets, put back on the sphere.
///
/// No tetrahedron has all four nodes on the surface: its circumsphere would be the unit sphere, which is not empty.
BallMesh lay_out_ball(const BallLayout& layout, const Tetrahedralize& tetrahedralize);

} // namespace mpfem
