#pragma once
// Neighbours among points in a box, by a grid of cells.

#include <algorithm>
#include <cmath>
#include <vector>

#include "pack-gen/tet_mesh.hpp"

namespace mpfem {

/// Points sorted into cells of a grid over the box.
struct CellGrid {
  CellGrid(const std::vector<Point>& center, const Point& box, double cell_size) {
    const auto n = static_cast<double>(center.size());
    for (std::size_t k = 0; k < 3; ++k) {
      // At most four cells for each sphere along an axis, were the spheres spread evenly over a cube, and 512: a tiny
      // cell size must not exhaust the memory.
      const double most = std::clamp(std::cbrt(n) * 4, 1.0, 512.0);
      cells[k] = static_cast<int>(std::clamp(std::floor(box[k] / cell_size), 1.0, most));
      inverse_size[k] = cells[k] / box[k];
    }
    const auto total =
        static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(cells[2]);
    offset.assign(total + 1, 0);
    std::vector<std::size_t> cell_of(center.size());
    for (std::size_t i = 0; i < center.size(); ++i) {
      cell_of[i] = index(coordinate(center[i], 0), coordinate(center[i], 1), coordinate(center[i], 2));
      ++offset[cell_of[i] + 1];
    }
    for (std::size_t c = 0; c < total; ++c) offset[c + 1] += offset[c];
    member.resize(center.size());
    std::vector<int> next(offset.begin(), offset.end() - 1);
    for (std::size_t i = 0; i < center.size(); ++i)
      member[static_cast<std::size_t>(next[cell_of[i]]++)] = static_cast<int>(i);
  }

  int coordinate(const Point& p, std::size_t k) const {
    // Points far outside belong to the last cell; their own cell number would overflow.
    return static_cast<int>(std::clamp(std::floor(p[k] * inverse_size[k]), 0.0, cells[k] - 1.0));
  }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells[0]) +
           static_cast<std::size_t>(x);
  }
  /// Calls visit(j) for each point in the cell of `p` and the 26 around it.
  template <class Visit>
  void around(const Point& p, Visit visit) const {
    const int cx = coordinate(p, 0), cy = coordinate(p, 1), cz = coordinate(p, 2);
    for (int z = std::max(cz - 1, 0); z <= std::min(cz + 1, cells[2] - 1); ++z)
      for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, cells[1] - 1); ++y)
        for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, cells[0] - 1); ++x) {
          const std::size_t cell = index(x, y, z);
          for (int m = offset[cell]; m < offset[cell + 1]; ++m) visit(member[static_cast<std::size_t>(m)]);
        }
  }

  std::array<int, 3> cells{};
  Point inverse_size{};
  std::vector<int> offset, member;
};

/// Calls visit(i, j), i < j, for every pair of points at most `reach` apart, and some farther ones.
template <class Visit>
void for_each_pair_within(const std::vector<Point>& points, const Point& box, double reach, Visit visit) {
  const CellGrid grid(points, box, reach);
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    grid.around(points[static_cast<std::size_t>(i)], [&](int j) {
      if (j > i) visit(i, j);
    });
}

} // namespace mpfem
