#pragma once
// A rigid body or a container with a closed surface of triangles: signed distance and its gradient at any point.
//
// The distance is that to the closest point of all triangles; its sign comes from the pseudonormal of the face, edge or
// corner there (pseudonormals.hpp). The normal is the direction from the closest point: the exact gradient of the
// distance, so that a penalty energy of the distance is conservative. It jumps where two points of the surface are
// equally close: in the middle of the body, and in front of its concave edges.
//
// Only nodes are tested: an edge sharper than their spacing can pass between them undetected, and a node deeper than
// half of the body's thickness is pushed out at the other side.

#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/pseudonormals.hpp"
#include "surfaces/triangle_mesh.hpp"
#include "surfaces/triangle_tree.hpp"

namespace mpfem {

/// The side of the surface on which the grains are.
enum class GrainSide {
  outside, ///< the surface is a body
  inside   ///< the surface is a container, as the inside of a die or a hopper
};

/// Distance of a point from a surface, and the direction in which the surface pushes it.
struct SurfaceGap {
  double distance;              ///< mm, negative behind the surface
  std::array<double, 3> normal; ///< unit, towards the grains
};

/// Immutable after construction: any number of threads may use it at once.
class TriangulatedSurface {
public:
  /// Throws InputError where the surface is not closed and oriented; surfaces of read_stl (stl.hpp) always are.
  explicit TriangulatedSurface(const TriangleMesh& mesh, GrainSide side = GrainSide::outside);

  /// Gap at a point in the surface's own frame (mm).
  SurfaceGap gap(const std::array<double, 3>& x) const;
  /// The same for distances up to `reach` (mm). Beyond, the distance returned is above `reach` but not above the true
  /// distance, and the normal may be zero; most such points need no search.
  SurfaceGap gap(const std::array<double, 3>& x, double reach) const;
  /// The sphere of radius r around a point on the grains' side, against all triangles at once: a gap whose distance is
  /// at most that of `gap`, and whose normal need not have the length 1. Triangle t is overlapped by o_t = r - its
  /// distance, where that is positive. The overlap o = r - distance is (sum of o_t^4)^(1/4), and the normal is the
  /// gradient of the distance. Both change continuously, unlike those of the closest place alone: in corners, a penalty
  /// energy of o has a minimum where its forces balance.
  SurfaceGap gap_of_sphere(const std::array<double, 3>& x, double radius) const;
  /// False if no point within the bounds lies behind the surface; true if one may.
  bool may_touch(const Bounds& bounds) const;
  /// Bounding box of the triangles, mm.
  const Bounds& bounds() const { return bounds_; }
  GrainSide side() const { return sign_ < 0 ? GrainSide::inside : GrainSide::outside; }

private:
  /// Data for all points in a block of space.
  struct Block {
    double distance = 0;       ///< mm, lower bound at its centre in magnitude; positive outside the body
    std::int32_t triangle = 0; ///< a triangle close to its centre
  };
  struct Surroundings {
    const Block& block;
    double away; ///< mm, distance of the point from the block's centre
  };

  TriangulatedSurface(const TriangleMesh& mesh, const std::vector<FlatTriangle>& triangles, GrainSide side);
  SurfaceGap body_gap(const Vector3<double>& x, const Nearest& nearest) const;
  SurfaceGap grain_gap(const Vector3<double>& x, std::int32_t first) const;
  Surroundings surroundings(const Vector3<double>& x) const;
  Vector3<double> centre_of_block(std::size_t i, std::size_t j, std::size_t k) const;
  double outside_bounds(const Vector3<double>& x) const;
  void set_blocks();
  void fill_blocks();
  Block block_at(std::array<std::size_t, 3> place) const;

  Pseudonormals pseudonormals_;
  Bounds bounds_;
  double sign_;     ///< 1: body, -1: container
  double touching_; ///< mm: closer to an edge or corner than this, its pseudonormal is the normal
  TriangleTree tree_;
  std::array<std::size_t, 3> blocks_{}; ///< along each axis
  std::array<double, 3> width_{};       ///< mm, of a block
  std::vector<Block> block_;            ///< x varies slowest
};

} // namespace mpfem
