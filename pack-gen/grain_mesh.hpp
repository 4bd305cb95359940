#pragma once
// Tetrahedral meshes of spheres at a nominal size. The only part that knows gmsh, which makes the Delaunay tetrahedra.
//
// A library holds one mesh of the unit ball for each ratio radius/size, in steps of 2 %. There are up to eight
// candidates, each with its nodes moved to raise its smallest critical step. The first one that is good enough is
// taken, else the best. A grain is a library mesh, turned at random and scaled so that the mesh has exactly the
// sphere's volume; its surface nodes then lie a little outside the sphere.
//
// Nominal size h: the mean tetrahedron has the volume h^3/11.05. The paper's four meshes (188,760, 342,919, 1,599,106
// and 12,015,373 tetrahedra in 0.47327 mm^3 at h = 0.03, 0.025, 0.015 and 0.0075 mm) give 10.77, 11.32, 11.40
// and 10.71; with 11.05, the middle of their range, all four counts are met within 3.2 %, plus the 1.5 % to which a
// ball's count is fitted.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "pack-gen/ball_points.hpp"
#include "pack-gen/mesh_checks.hpp"
#include "pack-gen/packing.hpp"

namespace mpfem {

/// Tetrahedra in a volume h^3.
inline constexpr double tets_per_cubed_size = 11.05;
/// Smallest ratio radius/size that gives a ball (icosahedron with a few nodes inside).
inline constexpr double smallest_size_ratio = 1.0;

/// Delaunay tetrahedra by gmsh; see Tetrahedralize. Safe to call from several threads (they take turns).
std::vector<Tet> gmsh_tetrahedralize(const std::vector<Point>& points);

/// Tetrahedra of the half-ball z >= 0 of a radius (mm) about the origin, with an element size (mm) given at every
/// point. Nodes of the flat face have z = 0 exactly, those of the curved face lie on the sphere. Throws SimulationError
/// if gmsh fails.
TetMesh gmsh_half_ball(double radius, const std::function<double(const Point&)>& size);

/// A library mesh.
struct UnitBall {
  BallMesh ball;
  double volume = 0;        ///< of the mesh, for surface nodes at radius 1
  double smallest_step = 0; ///< in units of radius/wave speed, Poisson's ratio 0.3
  std::string note;         ///< what had to be changed to get it; empty if nothing
};

/// The ball of unit radius meshed for a ratio radius/size >= smallest_size_ratio. Without `optimise`: the first valid
/// candidate without moved nodes (to see the gain of choosing candidates and moving nodes). Throws SimulationError when
/// no attempt gives a valid mesh.
UnitBall mesh_unit_ball(double size_ratio, std::uint64_t seed, bool optimise = true);

/// All grains' meshes, grain by grain.
struct PackingMesh {
  std::vector<double> node;                    ///< [nodes * 3], mm
  std::vector<std::int32_t> tet;               ///< [tets * 4], 0-based
  std::vector<std::int32_t> grain_node_offset; ///< [spheres + 1]
  std::vector<std::int32_t> grain_tet_offset;  ///< [spheres + 1]
  std::vector<std::string> notes;              ///< changes that had to be made, one line each
};

/// How the spheres of a packing are to be meshed.
struct MeshRequest {
  double nominal_size = 0; ///< mm
  std::uint64_t seed = 1;  ///< of the grains' orientations
  int threads = 1;         ///< the mesh does not depend on it
  bool optimise = true;    ///< balls are chosen and their nodes moved for a larger critical step
  double memory = std::numeric_limits<double>::infinity(); ///< bytes that it may take
  std::function<void(double fraction, const std::string& what)> progress{};
};

/// Meshes every sphere. Throws InputError when the size is too large for the smallest sphere, when there are more nodes
/// or tets than 32-bit indices can number or the memory can hold, or when no orientation keeps the facets of two
/// grains, or of a grain and a wall, apart.
PackingMesh mesh_packing(const SpherePacking& packing, const MeshRequest& request);

} // namespace mpfem
