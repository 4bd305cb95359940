#pragma once
// Closed surfaces of triangles, and the two forms of STL files.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "surfaces/weld_corners.hpp"

namespace mpfem::test {

using Point = Vector3<double>;
/// Triangles with their own corners, as in an STL file; counter-clockwise from outside.
using LooseTriangles = std::vector<std::array<Point, 3>>;

/// A prism from z = low to high over a polygon, counter-clockwise, that its first corner sees as a whole.
inline LooseTriangles prism(const std::vector<std::array<double, 2>>& polygon, double low, double high) {
  LooseTriangles triangles;
  const std::size_t n = polygon.size();
  const auto at = [&](std::size_t i, double z) { return Point{polygon[i % n][0], polygon[i % n][1], z}; };
  for (std::size_t i = 0; i < n; ++i) {
    triangles.push_back({at(i, low), at(i + 1, low), at(i + 1, high)});
    triangles.push_back({at(i, low), at(i + 1, high), at(i, high)});
    if (i == 0 || i + 1 == n) continue;
    triangles.push_back({at(0, high), at(i, high), at(i + 1, high)});
    triangles.push_back({at(0, low), at(i + 1, low), at(i, low)});
  }
  return triangles;
}

/// A tube from z = low to high between two polygons with as many corners, counter-clockwise, one around the other.
inline LooseTriangles tube(const std::vector<std::array<double, 2>>& hole,
                           const std::vector<std::array<double, 2>>& outside, double low, double high) {
  LooseTriangles triangles;
  const std::size_t n = hole.size();
  const auto quad = [&](const Point& a, const Point& b, const Point& c, const Point& d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (std::size_t i = 0; i < n; ++i) {
    const auto inner = [&](std::size_t k, double z) { return Point{hole[k % n][0], hole[k % n][1], z}; };
    const auto outer = [&](std::size_t k, double z) { return Point{outside[k % n][0], outside[k % n][1], z}; };
    quad(outer(i, low), outer(i + 1, low), outer(i + 1, high), outer(i, high));
    quad(inner(i + 1, low), inner(i, low), inner(i, high), inner(i + 1, high));
    quad(outer(i, high), outer(i + 1, high), inner(i + 1, high), inner(i, high));
    quad(inner(i, low), inner(i + 1, low), outer(i + 1, low), outer(i, low));
  }
  return triangles;
}

/// Polygons for prism(), counter-clockwise.
inline const std::vector<std::array<double, 2>> unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
inline const std::vector<std::array<double, 2>> l_shape{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

/// Corners on a circle about the origin, the first on the x-axis.
inline std::vector<std::array<double, 2>> regular_polygon(int corners, double radius) {
  std::vector<std::array<double, 2>> polygon;
  for (int i = 0; i < corners; ++i)
    polygon.push_back({radius * std::cos(2 * M_PI * i / corners), radius * std::sin(2 * M_PI * i / corners)});
  return polygon;
}

/// The cube [0, 1]^3.
inline LooseTriangles unit_cube() {
  return prism(unit_square, 0, 1);
}

/// All triangles shifted by `way`.
inline LooseTriangles moved(LooseTriangles triangles, const Point& way) {
  for (auto& triangle : triangles)
    for (Point& x : triangle) x = x + way;
  return triangles;
}

/// The same surface with its normals reversed.
inline LooseTriangles inside_out(LooseTriangles triangles) {
  for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
  return triangles;
}

/// Both surfaces in one list.
inline LooseTriangles together(LooseTriangles a, const LooseTriangles& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Rings of points around the z-axis from pole to pole; `radius(ring, i)` from the origin: the body that it sees whole.
template <class Radius, class Angle>
LooseTriangles globe(int rings, int around, Radius radius, Angle longitude) {
  const auto at = [&](int ring, int i) {
    const bool pole = ring == 0 || ring == rings;
    const double theta = M_PI * ring / rings, phi = pole ? 0 : longitude(ring, i % around);
    const double r = radius(ring, pole ? 0 : i % around);
    return pole ? Point{0, 0, ring == 0 ? r : -r}
                : Point{r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
  };
  LooseTriangles triangles;
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < around; ++i) {
      if (ring + 1 < rings) triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      if (ring > 0) triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
  return triangles;
}

inline LooseTriangles ball(int rings, int around, double radius) {
  return globe(
      rings, around, [&](int, int) { return radius; }, [&](int, int i) { return 2 * M_PI * i / around; });
}

/// A body of spikes and dents, with triangles of all shapes.
inline LooseTriangles spiky_ball(int rings, int around, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<double> radius, shift;
  for (int i = 0; i < (rings + 1) * around; ++i) radius.push_back(0.2 + share(random)), shift.push_back(share(random));
  const auto at = [around](int ring, int i) { return static_cast<std::size_t>(ring * around + i); };
  return globe(
      rings, around, [&](int ring, int i) { return radius[at(ring, i)]; },
      [&](int ring, int i) { return 2 * M_PI * (i + 0.9 * shift[at(ring, i)]) / around; });
}

/// The mesh of loose triangles whose shared corners are alike but for rounding.
inline TriangleMesh welded(const LooseTriangles& triangles) {
  return weld_corners(triangles, 1e-5);
}

inline Point normal_of(const std::array<Point, 3>& x) {
  const Point area = area_vector(x[0], x[1], x[2]);
  return norm(area) > 0 ? (1 / norm(area)) * area : area;
}

inline void append_bytes(std::string& bytes, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xFFU);
}

inline std::string binary_stl(const LooseTriangles& triangles, std::string head = "made by a test") {
  head.resize(80, ' ');
  append_bytes(head, static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    for (const Point& x : {normal_of(triangle), triangle[0], triangle[1], triangle[2]})
      for (const double c : {x.x, x.y, x.z}) append_bytes(head, std::bit_cast<std::uint32_t>(static_cast<float>(c)));
    head += std::string(2, '\0');
  }
  return head;
}

inline std::string text_stl(const LooseTriangles& triangles, const std::string& name = "part of a test") {
  std::string text = "solid " + name + "\n";
  for (const auto& triangle : triangles) {
    const Point n = normal_of(triangle);
    text += fmt::format("  facet normal {} {} {}\n    outer loop\n", n.x, n.y, n.z);
    for (const Point& x : triangle) text += fmt::format("      vertex {} {} {:.17e}\n", x.x, x.y, x.z);
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

} // namespace mpfem::test
