#include "surfaces/pseudonormals.hpp"

#include <algorithm>
#include <cmath>

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

namespace {

/// Angle (rad) of a triangle at its corner k.
double angle_at(const FlatTriangle& triangle, std::size_t k) {
  const Vector3<double> a = triangle.corner[(k + 1) % 3] - triangle.corner[k];
  const Vector3<double> b = triangle.corner[(k + 2) % 3] - triangle.corner[k];
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

/// Where normals cancel, as along the edge of a sheet without thickness, any direction serves.
Vector3<double> unit(const Vector3<double>& sum, const Vector3<double>& otherwise) {
  const double length = norm(sum);
  return length > 0 ? (1 / length) * sum : otherwise;
}

void add_edges(std::span<const FlatTriangle> triangles, const std::vector<std::int32_t>& partner, Pseudonormals& all) {
  for (std::size_t edge = 0; edge < partner.size(); ++edge) {
    const auto other = static_cast<std::size_t>(partner[edge]);
    auto& number = all.edge_or_corner[edge / 3][edge % 3];
    if (other < edge) {
      number = all.edge_or_corner[other / 3][other % 3];
      continue;
    }
    const Vector3<double>& normal = triangles[edge / 3].normal;
    number = static_cast<std::int32_t>(all.direction.size());
    all.direction.push_back(unit(normal + triangles[other / 3].normal, normal));
  }
}

void add_corners(std::span<const FlatTriangle> triangles, const std::vector<std::int32_t>& partner,
                 Pseudonormals& all) {
  const std::vector<std::int32_t> fan = corner_fans(partner);
  const std::size_t first = all.direction.size(), fans = static_cast<std::size_t>(*std::ranges::max_element(fan)) + 1;
  std::vector<Vector3<double>> sum(fans, {0, 0, 0});
  for (std::size_t corner = 0; corner < fan.size(); ++corner) {
    const auto f = static_cast<std::size_t>(fan[corner]);
    sum[f] = sum[f] + angle_at(triangles[corner / 3], corner % 3) * triangles[corner / 3].normal;
    all.edge_or_corner[corner / 3][3 + corner % 3] = static_cast<std::int32_t>(first + f);
  }
  for (const Vector3<double>& direction : sum) all.direction.push_back(unit(direction, direction));
}

} // namespace

Pseudonormals pseudonormals(std::span<const FlatTriangle> triangles, const std::vector<std::int32_t>& partner) {
  Pseudonormals all;
  all.edge_or_corner.resize(triangles.size());
  add_edges(triangles, partner, all);
  add_corners(triangles, partner, all);
  return all;
}

} // namespace mpfem
