#include "postproc/drawing/tool_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace mpfem {

namespace {

constexpr std::int32_t circle_corners = 120;
using Triangle = std::array<std::int32_t, 3>;

/// Appends nodes and tets of one body.
class TetBuilder {
public:
  TetBuilder(Snapshot& tets, std::int32_t body) : tets_(tets), body_(body) {}

  std::int32_t add_node(const std::array<double, 3>& x) {
    for (const double c : x) tets_.node.push_back(static_cast<float>(c));
    return static_cast<std::int32_t>(tets_.nodes()) - 1;
  }

  /// A prism between two triangles, corner by corner; tets with coinciding corners are left out. All prisms take their
  /// corners in the same order, so that neighbours split their common side in the same way (Freudenthal 1942).
  void add_prism(const Triangle& a, const Triangle& b) {
    add_tet({a[0], a[1], a[2], b[2]});
    add_tet({a[0], a[1], b[1], b[2]});
    add_tet({a[0], b[0], b[1], b[2]});
  }

private:
  Eigen::Vector3d position(std::int32_t node) const {
    const float* x = tets_.node.data() + 3 * static_cast<std::size_t>(node);
    return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
  }
  void add_tet(std::array<std::int32_t, 4> node) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (node[i] == node[j]) return;
    const Eigen::Vector3d at = position(node[0]);
    const double volume = (position(node[1]) - at).cross(position(node[2]) - at).dot(position(node[3]) - at);
    if (volume < 0) std::swap(node[0], node[1]);
    tets_.tet.insert(tets_.tet.end(), node.begin(), node.end());
    tets_.tet_grain.push_back(body_);
  }

  Snapshot& tets_;
  std::int32_t body_;
};

std::vector<ProfilePoint> without_repeats(const std::vector<ProfilePoint>& profile) {
  std::vector<ProfilePoint> points;
  const auto differ = [](const ProfilePoint& a, const ProfilePoint& b) {
    return std::hypot(a.radius - b.radius, a.along - b.along) > 1e-12 * (1 + std::abs(a.along) + a.radius);
  };
  for (const ProfilePoint& p : profile)
    if (points.empty() || differ(points.back(), p)) points.push_back(p);
  if (points.size() > 1 && !differ(points.front(), points.back())) points.pop_back();
  return points;
}

/// Triangles of a profile with this number of points; the corners ascend.
std::vector<Triangle> triangles_of_profile(std::int32_t points, bool strip) {
  std::vector<Triangle> triangles;
  if (!strip)
    for (std::int32_t i = 2; i < points; ++i) triangles.push_back({0, i - 1, i});
  else
    for (std::int32_t i = 0; i + 1 < points / 2; ++i) {
      triangles.push_back({i, i + 1, points - 2 - i});
      triangles.push_back({i, points - 2 - i, points - 1 - i});
    }
  return triangles;
}

void add_turned(TetBuilder builder, const Revolved& body) {
  const std::size_t u = (body.axis + 1) % 3, v = (body.axis + 2) % 3;
  const std::vector<ProfilePoint> profile = body.strip ? body.profile : without_repeats(body.profile);
  std::vector<std::vector<std::int32_t>> node; // [slices][points]; on the axis the same in all slices
  for (int slice = 0; slice < circle_corners; ++slice) {
    const double angle = 2 * M_PI * slice / circle_corners;
    std::vector<std::int32_t> ring;
    for (const ProfilePoint& p : profile) {
      std::array<double, 3> x = body.centre;
      x[body.axis] += p.along;
      x[u] += p.radius * std::cos(angle);
      x[v] += p.radius * std::sin(angle);
      const bool shared = slice > 0 && p.radius == 0;
      ring.push_back(shared ? node[0][ring.size()] : builder.add_node(x));
    }
    node.push_back(std::move(ring));
  }
  const auto triangles = triangles_of_profile(static_cast<std::int32_t>(profile.size()), body.strip);
  for (std::size_t slice = 0; slice < node.size(); ++slice) {
    const auto &here = node[slice], &next = node[(slice + 1) % node.size()];
    const auto in = [](const std::vector<std::int32_t>& ring, const Triangle& t) {
      return Triangle{ring[static_cast<std::size_t>(t[0])], ring[static_cast<std::size_t>(t[1])],
                      ring[static_cast<std::size_t>(t[2])]};
    };
    for (const Triangle& t : triangles) builder.add_prism(in(here, t), in(next, t));
  }
}

void add_slab(TetBuilder builder, const Faceted& slab) {
  std::vector<std::int32_t> node;
  for (const auto& x : slab.vertex) node.push_back(builder.add_node(x));
  const std::size_t n = slab.front;
  for (std::size_t i = 2; i < n; ++i)
    builder.add_prism({node[0], node[i - 1], node[i]}, {node[n], node[n + i - 1], node[n + i]});
}

/// The triangles of a body that has no tets.
void add_shell(std::vector<SolidTriangle>& triangles, const Faceted& body, std::int32_t number) {
  for (const auto& t : body.triangle) {
    SolidTriangle triangle;
    triangle.grain = number;
    for (std::size_t c = 0; c < 3; ++c)
      triangle.corner[c].position = Eigen::Vector3d(body.vertex[static_cast<std::size_t>(t[c])].data());
    const Eigen::Vector3d& a = triangle.corner[0].position;
    const Eigen::Vector3d normal =
        (triangle.corner[1].position - a).cross(triangle.corner[2].position - a).normalized();
    for (SolidVertex& vertex : triangle.corner) vertex.normal = normal;
    triangles.push_back(triangle);
  }
}

std::vector<SolidTriangle> within(std::vector<SolidTriangle> triangles, const DrawnExtent& extent) {
  const double more = 0.5 * extent.thickness;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    triangles = cut_surface(triangles, {{unit, extent.low[k] - more}});
    triangles = cut_surface(triangles, {{-unit, -(extent.high[k] + more)}});
  }
  return triangles;
}

} // namespace

Snapshot tool_tets(const std::vector<ToolBody>& bodies) {
  Snapshot tets;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const TetBuilder builder(tets, static_cast<std::int32_t>(i));
    if (bodies[i].is_turned())
      add_turned(builder, bodies[i].turned);
    else if (bodies[i].faceted.front > 0)
      add_slab(builder, bodies[i].faceted);
  }
  return tets;
}

std::vector<SolidTriangle> tool_surface(const std::vector<ToolBody>& bodies, const DrawnExtent& extent,
                                        const CutAway& away) {
  const Snapshot tets = tool_tets(bodies);
  const ShownField none{"tool", "1", std::vector<double>(tets.nodes(), std::numeric_limits<double>::quiet_NaN()), true};
  std::vector<SolidTriangle> triangles = cut_solid(tets, none, away), shells;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].is_turned() && bodies[i].faceted.front == 0)
      add_shell(shells, bodies[i].faceted, static_cast<std::int32_t>(i));
  shells = cut_surface(shells, away);
  triangles.insert(triangles.end(), shells.begin(), shells.end());
  return within(std::move(triangles), extent);
}

} // namespace mpfem
