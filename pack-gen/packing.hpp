#pragma once
// Random packings of spheres in a box, a cylinder or a closed surface of hard walls, denser than random sequential
// addition can make them.
//
// Method: spheres inflated by half the wanted gap repel each other and the walls where they overlap; from random points
// the overlap energy is minimised with FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006). Below random close
// packing (about 0.64 in the bulk, less between walls) the energy reaches zero. A packing that jams is shrunk and grown
// again by Monte Carlo moves and exchanges of spheres, which packs still denser; if it jams then, it is refused.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pack-gen/container.hpp"
#include "pack-gen/tet_mesh.hpp"

namespace mpfem {

/// Spheres in a container that spans [0, box].
struct SpherePacking {
  Point box{};                ///< mm
  std::vector<Point> center;  ///< mm
  std::vector<double> radius; ///< mm
  ContainerShape shape = ContainerShape::box;
  std::shared_ptr<const SurfaceContainer> surface{}; ///< where the container is one

  PackingContainer container() const { return {box, shape, surface}; }
};

/// Smallest surface distance, and where it is. `second` is -1 - wall for a wall, numbered as in container.hpp.
struct SphereGap {
  double gap = 0; ///< mm; negative: overlap
  int first = -1;
  int second = -1;
};

/// Smallest gap between two spheres; exact. Infinite for one sphere.
SphereGap smallest_sphere_gap(const SpherePacking& packing);
/// Smallest gap between a sphere and a wall.
SphereGap smallest_wall_gap(const SpherePacking& packing);
/// The smaller of the two.
SphereGap smallest_gap(const SpherePacking& packing);

/// Sum of sphere volumes over the container's volume.
double relative_density(const SpherePacking& packing);

/// What pack_spheres needs.
struct PackingRequest {
  Point box{}; ///< mm
  ContainerShape shape = ContainerShape::box;
  std::shared_ptr<const SurfaceContainer> surface{}; ///< where the container is one
  std::vector<double> radius;                        ///< mm
  double smallest_gap = 0;                           ///< mm, between spheres and to the walls
  std::uint64_t seed = 1;
  std::int64_t moves = 100'000'000; ///< random moves at most, where minimising the overlap is not enough
  /// Called now and then with what is being done.
  std::function<void(const std::string& state)> progress{};
};

/// A packing with these radii, order kept, in which every gap is at least `smallest_gap`. The same request gives the
/// same packing. Throws InputError, stating the density reached, when the spheres jam first.
SpherePacking pack_spheres(const PackingRequest& request);

} // namespace mpfem
