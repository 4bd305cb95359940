#include "postproc/drawing/section.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

std::vector<SectionPolygon> cut(const Snapshot& snapshot, const CutPlane& plane) {
  const auto axis = static_cast<std::size_t>(plane.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<SectionPolygon> polygons;
  for (std::size_t t = 0; t < snapshot.tets(); ++t) {
    std::array<std::array<double, 3>, 4> x{};
    std::array<double, 4> height{};
    std::array<std::size_t, 4> below{}, above{};
    std::size_t belows = 0, aboves = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto node = static_cast<std::size_t>(snapshot.tet[4 * t + c]);
      for (std::size_t k = 0; k < 3; ++k) x[c][k] = static_cast<double>(snapshot.node[3 * node + k]);
      height[c] = x[c][axis] - plane.position;
      if (height[c] < 0)
        below[belows++] = c;
      else
        above[aboves++] = c;
    }
    if (belows == 0 || aboves == 0) continue;
    SectionPolygon polygon;
    polygon.tet = static_cast<std::int32_t>(t);
    const auto add = [&](std::size_t low, std::size_t high) {
      const double w = height[low] / (height[low] - height[high]);
      polygon.corner[static_cast<std::size_t>(polygon.corners++)] = {x[low][u] + w * (x[high][u] - x[low][u]),
                                                                     x[low][v] + w * (x[high][v] - x[low][v])};
    };
    if (belows == 2) { // the four cut edges form a ring: neighbours share a node
      add(below[0], above[0]);
      add(below[0], above[1]);
      add(below[1], above[1]);
      add(below[1], above[0]);
    } else {
      for (std::size_t i = 0; i < belows; ++i)
        for (std::size_t j = 0; j < aboves; ++j) add(below[i], above[j]);
    }
    polygons.push_back(polygon);
  }
  return polygons;
}

std::vector<SectionPolygon> cut_grains(const Snapshot& snapshot, const CutPlane& plane) {
  std::vector<SectionPolygon> polygons = cut(snapshot, plane);
  if (!polygons.empty()) return polygons;
  const auto axis = static_cast<std::size_t>(plane.axis);
  throw InputError(
      fmt::format("--position: the plane at {:g} mm cuts no grain; the box spans {:g} … {:g} mm along this axis",
                  plane.position, snapshot.box_low[axis], snapshot.box_high[axis]));
}

double area(const SectionPolygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0, n = static_cast<std::size_t>(polygon.corners); i < n; ++i) {
    const auto &a = polygon.corner[i], &b = polygon.corner[(i + 1) % n];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * std::abs(twice);
}

} // namespace mpfem
