#pragma once
// Walls around the spheres, and the distances of points and spheres from them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "pack-gen/tet_mesh.hpp"
#include "results-schema/container.hpp"
#include "surfaces/stl_size.hpp"
#include "surfaces/triangulated_surface.hpp"

namespace mpfem {

/// Walls are numbered: -x, +x, -y, +y, -z, +z = 0 … 5, the round one of a cylinder, and a surface of triangles.
inline constexpr int round_wall = 6, surface_wall = 7;

/// "wall -x", "round wall", "surface".
inline std::string wall_name(int wall) {
  static constexpr const char* flat[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
  if (wall == surface_wall) return "surface";
  return wall == round_wall ? "round wall" : std::string("wall ") + flat[wall];
}

/// "grain 3", or for -1 - wall "wall -x": what lies next to a grain.
inline std::string neighbour_name(int grain_or_wall) {
  return grain_or_wall < 0 ? wall_name(-1 - grain_or_wall) : "grain " + std::to_string(grain_or_wall);
}

/// The inside of a closed surface of triangles, whose lowest corner is at the origin.
struct SurfaceContainer {
  TriangleMesh mesh;           ///< mm
  TriangulatedSurface surface; ///< grains inside
  double volume = 0;           ///< mm^3
};

/// Where a surface is in its file and in the packing made in it.
struct PlacedSurface {
  std::shared_ptr<const SurfaceContainer> container;
  Point lengths{};        ///< mm, of the box that bounds it
  Point corner_in_file{}; ///< mm: the point that is the origin of the packing
  StlSize size{};         ///< for messages
};

/// Moves a closed surface to the origin. Throws InputError if it is not closed and oriented.
PlacedSurface place_surface(TriangleMesh mesh);
/// That of an STL file; `scale`: mm in its unit of length, which the user gives as `key`. Throws InputError as read_stl
/// does.
PlacedSurface read_surface(const std::string& path, const std::string& key, double scale);

/// A box that spans [0, lengths], the cylinder about z that touches its faces (then the first two lengths are the
/// diameter), or the inside of a surface that touches them.
struct PackingContainer {
  Point lengths{}; ///< mm
  ContainerShape shape = ContainerShape::box;
  std::shared_ptr<const SurfaceContainer> surface{}; ///< of a surface
  // A surface is not rebuilt when walls move inwards or lengths are in another unit.
  double unit = 1;         ///< mm of the surface in the current unit of length
  double inset = 0;        ///< mm, by which the walls have moved inwards; the origin has moved with the box
  bool open_above = false; ///< without the wall +z of a box or cylinder: nothing overlaps it

  double radius() const { return 0.5 * lengths[0]; } ///< mm, of the cylinder
  double from_axis(const Point& p) const { return std::hypot(p[0] - 0.5 * lengths[0], p[1] - 0.5 * lengths[1]); }
  /// Whether the faces of the box across this axis are walls: all of a box, across z of a cylinder.
  bool has_flat_walls(std::size_t axis) const {
    return shape == ContainerShape::box || (shape == ContainerShape::cylinder && axis == 2);
  }
  /// mm^3
  double volume() const { return surface ? surface->volume : container_volume(shape, lengths); }
  /// The container with its walls moved inwards by `inset` (mm), in another unit of length (mm).
  PackingContainer shrunk(double by, double in_unit) const {
    PackingContainer inner{{}, shape, surface, in_unit, by};
    for (std::size_t k = 0; k < 3; ++k) inner.lengths[k] = (lengths[k] - 2 * by) / in_unit;
    return inner;
  }
  /// Distance to the surface, negative outside, and its normal inwards.
  SurfaceGap surface_gap(const Point& p) const { return moved_in(surface->surface.gap(in_file(p))); }

  /// Calls visit(distance, wall) for each wall; negative outside.
  template <class Visit>
  void for_each_wall(const Point& p, Visit visit) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!has_flat_walls(k)) continue;
      visit(p[k], static_cast<int>(2 * k));
      visit(lengths[k] - p[k], static_cast<int>(2 * k + 1));
    }
    if (shape == ContainerShape::cylinder) visit(radius() - from_axis(p), round_wall);
    if (shape == ContainerShape::surface) visit(surface_gap(p).distance, surface_wall);
  }

  /// Distance to the nearest wall.
  double distance(const Point& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for_each_wall(p, [&](double distance, int) { nearest = std::min(nearest, distance); });
    return nearest;
  }

  /// Calls visit(overlap, inward) for each wall and a sphere of radius r at p: how far it reaches beyond the wall
  /// (negative: not at all), and by how much the overlap falls as the sphere moves: the wall's normal. A surface is one
  /// wall, with all of its triangles (TriangulatedSurface::gap_of_sphere).
  template <class Visit>
  void for_each_overlap(const Point& p, double r, Visit visit) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!has_flat_walls(k)) continue;
      Point inward{};
      inward[k] = 1;
      visit(r - p[k], inward);
      inward[k] = -1;
      if (k < 2 || !open_above) visit(p[k] + r - lengths[k], inward);
    }
    if (shape == ContainerShape::cylinder) {
      const double distance = from_axis(p), scale = distance > 0 ? -1 / distance : 0;
      visit(distance + r - radius(), Point{scale * (p[0] - 0.5 * lengths[0]), scale * (p[1] - 0.5 * lengths[1]), 0});
    }
    if (shape == ContainerShape::surface) {
      const SurfaceGap gap = moved_in(surface->surface.gap_of_sphere(in_file(p), r * unit + inset));
      visit(r - gap.distance, gap.normal);
    }
  }

  /// Whether a sphere stays within the walls.
  bool holds(const Point& p, double r) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < r || p[k] > lengths[k] - r) return false;
    if (shape == ContainerShape::surface) return surface_gap(p).distance >= r;
    return shape == ContainerShape::box || from_axis(p) <= radius() - r;
  }

private:
  /// mm in the surface's own frame, of a point here.
  Point in_file(const Point& p) const { return {p[0] * unit + inset, p[1] * unit + inset, p[2] * unit + inset}; }
  /// A gap to the surface, mm, as one to the wall that has moved inwards, in the current unit.
  SurfaceGap moved_in(SurfaceGap gap) const {
    gap.distance = (gap.distance - inset) / unit;
    return gap;
  }
};

/// Calls visit(gap, wall) for each wall and the points nearest to it; `nodes` is a matrix of three rows.
template <class Nodes, class Visit>
void for_each_wall_gap(const PackingContainer& container, const Nodes& nodes, Visit visit) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!container.has_flat_walls(k)) continue;
    const auto row = nodes.row(static_cast<int>(k));
    visit(row.minCoeff(), static_cast<int>(2 * k));
    visit(container.lengths[k] - row.maxCoeff(), static_cast<int>(2 * k + 1));
  }
  if (container.shape == ContainerShape::surface) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int n = 0; n < nodes.cols(); ++n)
      nearest = std::min(nearest, container.surface_gap({nodes(0, n), nodes(1, n), nodes(2, n)}).distance);
    visit(nearest, surface_wall);
  }
  if (container.shape != ContainerShape::cylinder) return;
  const auto x = nodes.row(0).array() - 0.5 * container.lengths[0],
             y = nodes.row(1).array() - 0.5 * container.lengths[1];
  visit(container.radius() - std::sqrt((x.square() + y.square()).maxCoeff()), round_wall);
}

} // namespace mpfem
