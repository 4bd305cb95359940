#include "surfaces/prism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpfem {

namespace {

constexpr double most_tilt = 1e-3; // z component of a unit normal

/// Point (x, y) at height z of the edge from a to b, which crosses it.
std::array<double, 2> crossing(const Vector3<double>& a, const Vector3<double>& b, double z) {
  const double t = (z - a.z) / (b.z - a.z);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// The line along which a plane across z cuts a triangle. A corner in the plane counts as above it, so that neighbours
/// agree on what is cut.
std::optional<std::array<std::array<double, 2>, 2>> cut(const TriangleMesh& mesh, std::size_t triangle, double z) {
  std::array<std::array<double, 2>, 2> ends{};
  std::size_t found = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3<double>&a = mesh.corner(triangle, k), &b = mesh.corner(triangle, (k + 1) % 3);
    if ((a.z < z) == (b.z < z)) continue;
    // From below to above for both triangles of an edge, so that both get the same point.
    ends.at(found++) = a.z < b.z ? crossing(a, b, z) : crossing(b, a, z);
  }
  if (found != 2) return std::nullopt;
  return ends;
}

} // namespace

std::optional<CrossSection> section_of_prism(const TriangleMesh& mesh, double low, double high) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double rounding = 1e-9 * (high - low), middle = 0.5 * (low + high);
  CrossSection section{{infinite, infinite}, {-infinite, -infinite}};
  std::array<double, 2> origin{};
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const Vector3<double>&a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    if (std::max({a.z, b.z, c.z}) <= low + rounding || std::min({a.z, b.z, c.z}) >= high - rounding) continue;
    const Vector3<double> normal = cross(b - a, c - a);
    if (std::abs(normal.z) > most_tilt * norm(normal)) return std::nullopt;
    const auto line = cut(mesh, t, middle);
    if (!line) continue;
    const auto& [from, to] = *line;
    if (section.perimeter == 0) origin = from;
    const double along[2] = {to[0] - from[0], to[1] - from[1]};
    section.perimeter += std::hypot(along[0], along[1]);
    // Twice the triangle between the line and the origin, positive where the outward normal points away from it.
    const double swept = std::abs((from[0] - origin[0]) * along[1] - (from[1] - origin[1]) * along[0]);
    const double side = (from[0] - origin[0]) * normal.x + (from[1] - origin[1]) * normal.y;
    section.area += 0.5 * std::copysign(swept, side);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      section.low[axis] = std::min({section.low[axis], from[axis], to[axis]});
      section.high[axis] = std::max({section.high[axis], from[axis], to[axis]});
    }
  }
  if (!(section.area > 0)) return std::nullopt;
  return section;
}

} // namespace mpfem
