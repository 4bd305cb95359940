#include "surfaces/triangulated_surface.hpp"

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"

namespace mpfem {

namespace {

constexpr double margin_share = 1e-13;   // of the diagonal: a few hundred rounding errors of a coordinate
constexpr double touching_share = 1e-10; // of the diagonal: a direction over this distance has six digits

std::vector<FlatTriangle> flat_triangles(const TriangleMesh& mesh) {
  std::vector<FlatTriangle> triangles;
  triangles.reserve(mesh.triangle.size());
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
    triangles.push_back(flat_triangle({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}));
  return triangles;
}

EdgePairs closed_edges(const TriangleMesh& mesh) {
  EdgePairs pairs = pair_edges(mesh);
  if (mesh.triangle.empty() || !pairs.closed())
    throw InputError("a surface of triangles is not closed and oriented, allowed: two triangles at every edge, in "
                     "opposite directions");
  return pairs;
}

} // namespace

TriangulatedSurface::TriangulatedSurface(const TriangleMesh& mesh, GrainSide side)
    : TriangulatedSurface(mesh, flat_triangles(mesh), side) {}

TriangulatedSurface::TriangulatedSurface(const TriangleMesh& mesh, const std::vector<FlatTriangle>& triangles,
                                         GrainSide side)
    : pseudonormals_(pseudonormals(triangles, closed_edges(mesh).partner)), bounds_(bounds_of(mesh)),
      sign_(side == GrainSide::inside ? -1 : 1), touching_(touching_share * diagonal(bounds_)),
      tree_(triangles, margin_share * diagonal(bounds_)) {
  set_blocks();
  fill_blocks();
}

SurfaceGap TriangulatedSurface::body_gap(const Vector3<double>& x, const Nearest& nearest) const {
  const FlatTriangle& triangle = tree_.triangle(nearest.triangle);
  if (nearest.feature == Feature::face) return {triangle.height(x), array_of(triangle.normal)};
  const Vector3<double>& pseudonormal = pseudonormals_.of(nearest.triangle, nearest.feature);
  const Vector3<double> way = x - nearest.point;
  const double length = std::sqrt(nearest.squared), side = dot(way, pseudonormal) < 0 ? -1 : 1;
  return {side * length, array_of(length > touching_ ? (side / length) * way : pseudonormal)};
}

SurfaceGap TriangulatedSurface::grain_gap(const Vector3<double>& x, std::int32_t first) const {
  SurfaceGap gap = body_gap(x, tree_.nearest(x, first));
  gap.distance *= sign_;
  for (double& n : gap.normal) n *= sign_;
  return gap;
}

SurfaceGap TriangulatedSurface::gap(const std::array<double, 3>& x) const {
  const Vector3<double> point = vector_of(x);
  return grain_gap(point, surroundings(point).block.triangle);
}

SurfaceGap TriangulatedSurface::gap(const std::array<double, 3>& x, double reach) const {
  const Vector3<double> point = vector_of(x);
  const auto [block, away] = surroundings(point);
  // The distances of two points differ by no more than the points are apart.
  double least = sign_ * block.distance - away;
  if (sign_ > 0) least = std::max(least, outside_bounds(point));
  if (least > reach) return {least, {}};
  return grain_gap(point, block.triangle);
}

SurfaceGap TriangulatedSurface::gap_of_sphere(const std::array<double, 3>& x, double radius) const {
  const SurfaceGap closest = gap(x, radius);
  if (closest.distance >= radius || closest.distance <= touching_) return closest; // apart, or its centre is outside
  const Vector3<double> centre = vector_of(x);
  // Overlaps over the largest one: powers of small numbers would underflow.
  const double largest = radius - closest.distance;
  double sum = 0;
  Vector3<double> away{};
  tree_.for_each_within(centre, radius, [&](const Nearest& nearest) {
    const FlatTriangle& triangle = tree_.triangle(nearest.triangle);
    const double distance = std::sqrt(nearest.squared), share = (radius - distance) / largest;
    const Vector3<double> way =
        nearest.feature == Feature::face ? triangle.height(centre) * triangle.normal : centre - nearest.point;
    sum += share * share * share * share;
    away = away + (share * share * share / distance) * way;
  });
  const double norm_of_shares = std::sqrt(std::sqrt(sum));
  const double scale = 1 / (norm_of_shares * norm_of_shares * norm_of_shares);
  return {radius - largest * norm_of_shares, array_of(scale * away)};
}

/// Distance (mm) of a point from the box around the triangles; 0 inside.
double TriangulatedSurface::outside_bounds(const Vector3<double>& x) const {
  const auto beyond = [&](std::size_t axis) {
    return std::max({bounds_.low[axis] - x[axis], x[axis] - bounds_.high[axis], 0.0});
  };
  return norm(Vector3<double>{beyond(0), beyond(1), beyond(2)});
}

bool TriangulatedSurface::may_touch(const Bounds& bounds) const {
  std::array<double, 3> centre{};
  for (std::size_t a = 0; a < 3; ++a) centre[a] = 0.5 * (bounds.low[a] + bounds.high[a]);
  const double reach = 0.5 * diagonal(bounds);
  return gap(centre, reach).distance <= reach;
}

Vector3<double> TriangulatedSurface::centre_of_block(std::size_t i, std::size_t j, std::size_t k) const {
  const auto along = [this](std::size_t axis, std::size_t n) {
    return bounds_.low[axis] + (static_cast<double>(n) + 0.5) * width_[axis];
  };
  return {along(0, i), along(1, j), along(2, k)};
}

TriangulatedSurface::Surroundings TriangulatedSurface::surroundings(const Vector3<double>& x) const {
  const auto number = [&](std::size_t axis, double value) {
    const double n = (value - bounds_.low[axis]) / width_[axis];
    return static_cast<std::size_t>(std::fmin(std::fmax(n, 0), static_cast<double>(blocks_[axis] - 1)));
  };
  const std::size_t i = number(0, x.x), j = number(1, x.y), k = number(2, x.z);
  return {block_[(i * blocks_[1] + j) * blocks_[2] + k], norm(x - centre_of_block(i, j, k))};
}

void TriangulatedSurface::set_blocks() {
  constexpr double most = 32'768, most_along = 128;
  const std::array<double, 3> length{bounds_.high[0] - bounds_.low[0], bounds_.high[1] - bounds_.low[1],
                                     bounds_.high[2] - bounds_.low[2]};
  const double width = std::max(std::cbrt(length[0] * length[1] * length[2] / most),
                                *std::max_element(length.begin(), length.end()) / most_along);
  for (std::size_t a = 0; a < 3; ++a) {
    blocks_[a] = static_cast<std::size_t>(std::max(1.0, std::round(length[a] / width)));
    width_[a] = length[a] / static_cast<double>(blocks_[a]);
  }
  block_.resize(blocks_[0] * blocks_[1] * blocks_[2]);
}

void TriangulatedSurface::fill_blocks() {
  std::size_t n = 0;
  for (std::size_t i = 0; i < blocks_[0]; ++i)
    for (std::size_t j = 0; j < blocks_[1]; ++j)
      for (std::size_t k = 0; k < blocks_[2]; ++k) block_[n++] = block_at({i, j, k});
}

TriangulatedSurface::Block TriangulatedSurface::block_at(std::array<std::size_t, 3> place) const {
  const Vector3<double> centre = centre_of_block(place[0], place[1], place[2]);
  const std::array<std::size_t, 3> back{blocks_[1] * blocks_[2], blocks_[2], 1};
  const std::size_t self = place[0] * back[0] + place[1] * back[1] + place[2];
  std::int32_t first = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (place[a] == 0) continue;
    const Block& before = block_[self - back[a]];
    first = before.triangle;
    if (std::abs(before.distance) <= width_[a]) continue;
    // The surface does not pass between the two centres: they are on the same side.
    constexpr double slack = 1.1;
    const Nearest near = tree_.nearest(centre, first, slack);
    return {std::copysign(std::sqrt(near.squared) / slack, before.distance), near.triangle};
  }
  const Nearest nearest = tree_.nearest(centre, first);
  return {body_gap(centre, nearest).distance, nearest.triangle};
}

} // namespace mpfem
