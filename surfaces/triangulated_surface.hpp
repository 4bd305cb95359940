#pragma once
// A rigid body, or a container, given by a closed surface of triangles: signed distance and its gradient at any point.
//
// The distance is that to the closest point of all triangles; the side is told by the pseudonormal of the face, edge or
// corner there (pseudonormals.hpp). The normal is the direction from the closest point, the exact gradient of the
// distance, so that a penalty energy of the distance is conservative. It jumps where two places of the surface are
// equally close: at the middle of the body, and in front of its concave edges.
//
// Only points are tested: an edge sharper than the spacing of the nodes goes in between them unseen, and a point deeper
// than half of the body's thickness is pushed out at the other side.

#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/pseudonormals.hpp"
#include "surfaces/triangle_mesh.hpp"
#include "surfaces/triangle_tree.hpp"

namespace mpfem {

/// Where the grains are.
enum class GrainSide {
  outside, ///< the surface is a body
  inside   ///< the surface is a container, as the inside of a die or a hopper
};

struct SurfaceGap {
  double distance;              ///< mm, negative behind the surface
  std::array<double, 3> normal; ///< unit, towards the grains
};

/// Does not change after it was made: any number of threads may ask at once.
class TriangulatedSurface {
public:
  /// Throws InputError where the surface is not closed and oriented; that of read_stl (stl.hpp) is.
  explicit TriangulatedSurface(const TriangleMesh& mesh, GrainSide side = GrainSide::outside);

  /// At a point in the surface's own frame, mm.
  SurfaceGap gap(const std::array<double, 3>& x) const;
  /// The same where the distance is up to `reach` (mm). Where it is more, the distance is some number above the reach
  /// that is no larger than the distance, and the normal may be zero; most such points cost no search.
  SurfaceGap gap(const std::array<double, 3>& x, double reach) const;
  /// False where no point within the bounds lies behind the surface; true where one may.
  bool may_touch(const Bounds& bounds) const;
  /// mm, of the triangles.
  const Bounds& bounds() const { return bounds_; }
  GrainSide side() const { return sign_ < 0 ? GrainSide::inside : GrainSide::outside; }

private:
  /// What is known of all points in a block of space.
  struct Block {
    double distance = 0;       ///< mm, that its centre has at least; positive outside of the body
    std::int32_t triangle = 0; ///< one that is close to its centre
  };
  struct Surroundings {
    const Block& block;
    double away; ///< mm, of the point from the block's centre
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
  double sign_;     ///< -1: container
  double touching_; ///< mm: closer to an edge or corner, its pseudonormal stands for the direction
  TriangleTree tree_;
  std::array<std::size_t, 3> blocks_{}; ///< along each axis
  std::array<double, 3> width_{};       ///< mm, of a block
  std::vector<Block> block_;            ///< x slowest
};

} // namespace mpfem
