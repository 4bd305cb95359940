#include "surfaces/weld_corners.hpp"

#include <cmath>
#include <unordered_map>

namespace mpfem {

namespace {

/// Vertices by grid cell. Cells are wider than the distance, so that most corners search only one cell.
class VertexGrid {
public:
  VertexGrid(const Vector3<double>& low, double distance) : low_(low), distance_(distance) {}

  /// The nearest vertex within the distance, or a new one.
  std::int32_t find_or_add(const Vector3<double>& x, std::vector<Vector3<double>>& vertices) {
    std::int32_t nearest = -1;
    double least = distance_ * distance_;
    const Vector3<double> reach{distance_, distance_, distance_};
    const auto from = cell_of(x - reach), to = cell_of(x + reach);
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t k = from[2]; k <= to[2]; ++k) {
          const auto found = first_in_.find(key({i, j, k}));
          for (auto v = found == first_in_.end() ? -1 : found->second; v >= 0; v = next_[static_cast<std::size_t>(v)]) {
            const Vector3<double> way = vertices[static_cast<std::size_t>(v)] - x;
            if (const double squared = dot(way, way); squared <= least) nearest = v, least = squared;
          }
        }
    return nearest >= 0 ? nearest : add(x, vertices);
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr double widths = 8; ///< width of a cell over the distance

  Cell cell_of(const Vector3<double>& x) const {
    const double width = widths * distance_;
    return {std::llround(std::floor((x.x - low_.x) / width)), std::llround(std::floor((x.y - low_.y) / width)),
            std::llround(std::floor((x.z - low_.z) / width))};
  }
  /// Distinct for all cells: 1e6 distances along each axis make 125,001 cells and one around them, fewer than 2^20.
  static std::uint64_t key(const Cell& cell) {
    const auto part = [](std::int64_t i) { return static_cast<std::uint64_t>(i + 1); };
    return part(cell[0]) << 40U | part(cell[1]) << 20U | part(cell[2]);
  }
  std::int32_t add(const Vector3<double>& x, std::vector<Vector3<double>>& vertices) {
    const auto v = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(x);
    const auto [place, is_first] = first_in_.try_emplace(key(cell_of(x)), v);
    next_.push_back(is_first ? -1 : place->second);
    place->second = v;
    return v;
  }

  Vector3<double> low_;
  double distance_;
  std::unordered_map<std::uint64_t, std::int32_t> first_in_;
  std::vector<std::int32_t> next_; ///< [vertices]: another vertex in the same cell; -1: none
};

Vector3<double> lowest(std::span<const std::array<Vector3<double>, 3>> triangles) {
  Vector3<double> low = triangles.front()[0];
  for (const auto& corners : triangles)
    for (const Vector3<double>& x : corners)
      low = {std::fmin(low.x, x.x), std::fmin(low.y, x.y), std::fmin(low.z, x.z)};
  return low;
}

} // namespace

TriangleMesh weld_corners(std::span<const std::array<Vector3<double>, 3>> triangles, double distance) {
  TriangleMesh mesh;
  if (triangles.empty()) return mesh;
  VertexGrid grid(lowest(triangles), distance);
  mesh.triangle.reserve(triangles.size());
  for (const auto& corners : triangles) {
    std::array<std::int32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = grid.find_or_add(corners[k], mesh.vertex);
    mesh.triangle.push_back(triangle);
  }
  return mesh;
}

} // namespace mpfem
