#pragma once
// Walls about the spheres: how far points and spheres are from them.

#include <cmath>
#include <string>

#include "pack-gen/tet_mesh.hpp"
#include "results-schema/container.hpp"

namespace mpfem {

/// Walls are numbered: -x, +x, -y, +y, -z, +z = 0 … 5, and the round one of a cylinder.
inline constexpr int round_wall = 6;

/// "wall -x", "round wall".
inline std::string wall_name(int wall) {
  static constexpr const char* flat[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
  return wall == round_wall ? "round wall" : std::string("wall ") + flat[wall];
}

/// A box that spans [0, lengths], or the cylinder about z that touches its faces; then the first two lengths are the
/// diameter.
struct PackingContainer {
  Point lengths{}; ///< mm
  ContainerShape shape = ContainerShape::box;

  double radius() const { return 0.5 * lengths[0]; } ///< mm, of the cylinder
  double from_axis(const Point& p) const { return std::hypot(p[0] - 0.5 * lengths[0], p[1] - 0.5 * lengths[1]); }
  /// First axis whose ends are flat walls: x, of a cylinder z.
  std::size_t first_flat_axis() const { return shape == ContainerShape::box ? 0 : 2; }

  /// Calls visit(distance, wall) for each wall; negative outside.
  template <class Visit>
  void for_each_wall(const Point& p, Visit visit) const {
    for (std::size_t k = first_flat_axis(); k < 3; ++k) {
      visit(p[k], static_cast<int>(2 * k));
      visit(lengths[k] - p[k], static_cast<int>(2 * k + 1));
    }
    if (shape == ContainerShape::cylinder) visit(radius() - from_axis(p), round_wall);
  }

  /// Distance to the nearest wall.
  double distance(const Point& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for_each_wall(p, [&](double distance, int) { nearest = std::min(nearest, distance); });
    return nearest;
  }

  /// Calls visit(overlap, inward) for each wall and a sphere of radius r at p: by how much it reaches beyond the wall
  /// (negative: not at all), and the wall's normal.
  template <class Visit>
  void for_each_overlap(const Point& p, double r, Visit visit) const {
    for (std::size_t k = first_flat_axis(); k < 3; ++k) {
      Point inward{};
      inward[k] = 1;
      visit(r - p[k], inward);
      inward[k] = -1;
      visit(p[k] + r - lengths[k], inward);
    }
    if (shape == ContainerShape::box) return;
    const double distance = from_axis(p), scale = distance > 0 ? -1 / distance : 0;
    visit(distance + r - radius(), Point{scale * (p[0] - 0.5 * lengths[0]), scale * (p[1] - 0.5 * lengths[1]), 0});
  }

  /// Whether a sphere stays within the walls.
  bool holds(const Point& p, double r) const {
    for (std::size_t k = first_flat_axis(); k < 3; ++k)
      if (p[k] < r || p[k] > lengths[k] - r) return false;
    return shape == ContainerShape::box || from_axis(p) <= radius() - r;
  }
};

/// Calls visit(gap, wall) for each wall and the points nearest to it; `nodes` is a matrix of three rows.
template <class Nodes, class Visit>
void for_each_wall_gap(const PackingContainer& container, const Nodes& nodes, Visit visit) {
  for (std::size_t k = container.first_flat_axis(); k < 3; ++k) {
    const auto row = nodes.row(static_cast<int>(k));
    visit(row.minCoeff(), static_cast<int>(2 * k));
    visit(container.lengths[k] - row.maxCoeff(), static_cast<int>(2 * k + 1));
  }
  if (container.shape == ContainerShape::box) return;
  const auto x = nodes.row(0).array() - 0.5 * container.lengths[0],
             y = nodes.row(1).array() - 0.5 * container.lengths[1];
  visit(container.radius() - std::sqrt((x.square() + y.square()).maxCoeff()), round_wall);
}

} // namespace mpfem
