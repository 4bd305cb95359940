#include "pack-gen/ball_points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <Eigen/Dense>

#include "pack-gen/mesh_checks.hpp"
#include "pack-gen/random.hpp"

namespace mpfem {

namespace {

using Eigen::Vector3d;

Vector3d vector(const Point& p) {
  return {p[0], p[1], p[2]};
}
Point point(const Vector3d& v) {
  return {v[0], v[1], v[2]};
}

std::vector<Point> spiral(int count) {
  std::vector<Point> points;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
    points.push_back({r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z});
  }
  return points;
}

/// Body-centred cubic lattice, cut to a radius. Its tetrahedra have the volume of a regular one with this edge.
std::vector<Point> cut_lattice(double edge, double radius, std::uint64_t seed) {
  Random random(seed);
  const double cube = edge * std::cbrt(12 / (6 * std::numbers::sqrt2)); // twelve tetrahedra fill a cube
  const Eigen::Matrix3d rotation = random.rotation();
  const Vector3d offset = cube * Vector3d(random.uniform(), random.uniform(), random.uniform());
  std::vector<Point> points;
  const int reach = static_cast<int>(radius / cube) + 2;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z)
        for (const double centre : {0.0, 0.5}) {
          const Vector3d p = rotation * (cube * Vector3d(x + centre, y + centre, z + centre) + offset);
          if (p.norm() < radius) points.push_back(point(p));
        }
  if (points.empty()) points.push_back({0, 0, 0});
  return points;
}

Vector3d circumcentre(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  Eigen::Matrix3d edges;
  edges << (b - a).transpose(), (c - a).transpose(), (d - a).transpose();
  const Vector3d half_squares = 0.5 * edges.rowwise().squaredNorm();
  return a + edges.inverse() * half_squares;
}

/// Facets on the sphere. Only tets with three surface nodes can have one, so the facets of other tets need no sorting.
std::vector<Facet> sphere_facets(const std::vector<Tet>& tet, std::size_t surface_nodes) {
  const auto on_surface = [&](std::int32_t node) { return static_cast<std::size_t>(node) < surface_nodes; };
  std::vector<Tet> outer;
  std::copy_if(tet.begin(), tet.end(), std::back_inserter(outer),
               [&](const Tet& t) { return std::count_if(t.begin(), t.end(), on_surface) >= 3; });
  std::vector<Facet> facets = boundary_facets(outer);
  std::erase_if(facets, [&](const Facet& f) { return !std::all_of(f.begin(), f.end(), on_surface); });
  return facets;
}

/// One round of smoothing.
void smooth(std::vector<Point>& points, std::size_t surface_nodes, const std::vector<Tet>& tet, double edge) {
  std::vector<Vector3d> sum(points.size(), Vector3d::Zero());
  std::vector<double> weight(points.size(), 0);
  for (const Tet& t : tet) {
    Vector3d corner[4];
    for (std::size_t k = 0; k < 4; ++k) corner[k] = vector(points[static_cast<std::size_t>(t[k])]);
    const double volume = (corner[1] - corner[0]).dot((corner[2] - corner[0]).cross(corner[3] - corner[0]));
    const Vector3d middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    Vector3d target = circumcentre(corner[0], corner[1], corner[2], corner[3]);
    // A sliver's circumcentre may lie anywhere: its pull is bounded.
    if (!((target - middle).norm() < edge)) target = middle;
    for (const std::int32_t n : t) {
      const auto i = static_cast<std::size_t>(n);
      if (i < surface_nodes) continue;
      sum[i] += volume * target;
      weight[i] += volume;
    }
  }
  for (const Facet& f : sphere_facets(tet, surface_nodes)) {
    const Vector3d a = vector(points[static_cast<std::size_t>(f[0])]),
                   b = vector(points[static_cast<std::size_t>(f[1])]),
                   c = vector(points[static_cast<std::size_t>(f[2])]);
    const double area = (b - a).cross(c - a).norm();
    for (const std::int32_t n : f) {
      sum[static_cast<std::size_t>(n)] += area * (a + b + c) / 3;
      weight[static_cast<std::size_t>(n)] += area;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(weight[i] > 0)) continue;
    const Vector3d target = sum[i] / weight[i];
    points[i] = point(i < surface_nodes ? target.normalized() : target);
  }
}

} // namespace

BallMesh lay_out_ball(const BallLayout& layout, const Tetrahedralize& tetrahedralize) {
  // Each surface node of a triangulation of equilateral triangles owns the area sqrt(3)/2 edge^2.
  const double share = std::sqrt(3.0) / 2 * layout.edge * layout.edge;
  const int surface_count = std::max(12, static_cast<int>(std::lround(4 * std::numbers::pi / share)));
  std::vector<Point> points = spiral(surface_count);
  const auto surface_nodes = points.size();
  const auto inside = cut_lattice(layout.edge * layout.interior_edge, 1 - layout.skin * layout.edge, layout.seed);
  points.insert(points.end(), inside.begin(), inside.end());

  std::vector<Tet> tet = tetrahedralize(points);
  for (int round = 0; round < layout.smoothing; ++round) {
    smooth(points, surface_nodes, tet, layout.edge);
    tet = tetrahedralize(points);
  }
  return {{std::move(points), std::move(tet)}, surface_nodes};
}

} // namespace mpfem
