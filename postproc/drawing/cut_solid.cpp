#include "postproc/drawing/cut_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "postproc/run_data/surface_facets.hpp"
#include "postproc/run_data/tet_geometry.hpp"

namespace mpfem {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
/// Facets that meet at a sharper angle keep their own normals there.
const double cosine_of_edge = std::cos(40 * M_PI / 180);

using Polygon = std::vector<SolidVertex>;

Eigen::Vector3d position_of(const Snapshot& snapshot, std::int32_t node) {
  const float* x = snapshot.node.data() + 3 * static_cast<std::size_t>(node);
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

SolidVertex between(const SolidVertex& a, const SolidVertex& b, double weight_of_b) {
  const auto mix = [&](const auto& from, const auto& to) { return from + weight_of_b * (to - from); };
  return {mix(a.position, b.position), mix(a.normal, b.normal).normalized(), mix(a.value, b.value)};
}

double depth(const HalfSpace& half_space, const Eigen::Vector3d& x) {
  return half_space.offset - half_space.normal.dot(x);
}

/// The parts of a convex polygon inside and outside a half-space (Sutherland and Hodgman 1974); either may be empty.
struct Parts {
  Polygon inside, outside;
};

Parts split(const Polygon& polygon, const HalfSpace& half_space) {
  Parts parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SolidVertex &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double here = depth(half_space, from.position), next = depth(half_space, to.position);
    (here > 0 ? parts.inside : parts.outside).push_back(from);
    if ((here > 0) == (next > 0)) continue;
    const SolidVertex crossing = between(from, to, here / (here - next));
    parts.inside.push_back(crossing);
    parts.outside.push_back(crossing);
  }
  return parts;
}

/// Adds the polygon as a fan of triangles.
void add_triangles(std::vector<SolidTriangle>& triangles, const Polygon& polygon, std::int32_t grain,
                   std::int32_t face) {
  for (std::size_t i = 2; i < polygon.size(); ++i)
    triangles.push_back({{polygon[0], polygon[i - 1], polygon[i]}, grain, face});
}

/// Adds what the half-spaces leave of a polygon of a grain's surface: for each in turn, the part outside it of what is
/// inside all half-spaces before.
void add_surface(std::vector<SolidTriangle>& triangles, Polygon polygon, std::int32_t grain, std::int32_t face,
                 const CutAway& away) {
  for (const HalfSpace& half_space : away) {
    Parts parts = split(polygon, half_space);
    add_triangles(triangles, parts.outside, grain, face);
    polygon = std::move(parts.inside);
  }
  if (away.empty()) add_triangles(triangles, polygon, grain, face);
}

/// The section of a tet with the plane that bounds a half-space: a triangle, a quadrilateral, or empty. Its normal
/// points into the half-space, because the solid is on the other side.
Polygon section(const SolidVertex (&corner)[4], const HalfSpace& half_space) {
  Polygon inside, outside, polygon;
  for (const SolidVertex& vertex : corner)
    (depth(half_space, vertex.position) > 0 ? inside : outside).push_back(vertex);
  const auto add = [&](const SolidVertex& a, const SolidVertex& b) {
    const double from = depth(half_space, a.position), to = depth(half_space, b.position);
    polygon.push_back(between(a, b, from / (from - to)));
  };
  if (inside.size() == 2 && outside.size() == 2) { // the four cut edges form a ring: neighbours share a corner
    add(inside[0], outside[0]);
    add(inside[0], outside[1]);
    add(inside[1], outside[1]);
    add(inside[1], outside[0]);
  } else {
    for (const SolidVertex& a : inside)
      for (const SolidVertex& b : outside) add(a, b);
  }
  if (polygon.size() < 3) return {};
  const Eigen::Vector3d outward = -half_space.normal;
  const Eigen::Vector3d turn =
      (polygon[1].position - polygon[0].position).cross(polygon[2].position - polygon[0].position);
  if (turn.dot(outward) < 0) std::reverse(polygon.begin(), polygon.end());
  for (SolidVertex& vertex : polygon) vertex.normal = outward;
  return polygon;
}

/// Adds the cut along half-space `cut`, as far as it lies in all the others.
void add_cut(std::vector<SolidTriangle>& triangles, const SolidVertex (&corner)[4], std::int32_t grain,
             const CutAway& away, std::size_t cut) {
  Polygon polygon = section(corner, away[cut]);
  for (std::size_t other = 0; other < away.size() && !polygon.empty(); ++other)
    if (other != cut) polygon = split(polygon, away[other]).inside;
  add_triangles(triangles, polygon, grain, static_cast<std::int32_t>(cut) + 1);
}

/// Twice the area times the unit normal of every facet.
std::vector<Eigen::Vector3d> area_vectors(const Snapshot& snapshot, const std::vector<SurfaceFacet>& facets) {
  std::vector<Eigen::Vector3d> result;
  result.reserve(facets.size());
  for (const SurfaceFacet& facet : facets) {
    const Eigen::Vector3d a = position_of(snapshot, facet.node[0]);
    result.push_back((position_of(snapshot, facet.node[1]) - a).cross(position_of(snapshot, facet.node[2]) - a));
  }
  return result;
}

/// The facets around every node: those of node n are facet[offset[n]] … facet[offset[n + 1] - 1].
struct FacetsOfNodes {
  std::vector<std::size_t> offset, facet;
};

FacetsOfNodes facets_of_nodes(std::size_t nodes, const std::vector<SurfaceFacet>& facets) {
  FacetsOfNodes result;
  result.offset.assign(nodes + 1, 0);
  for (const SurfaceFacet& facet : facets)
    for (const std::int32_t node : facet.node) ++result.offset[static_cast<std::size_t>(node) + 1];
  std::partial_sum(result.offset.begin(), result.offset.end(), result.offset.begin());
  std::vector<std::size_t> next(result.offset.begin(), result.offset.end() - 1);
  result.facet.resize(3 * facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const std::int32_t node : facets[f].node) result.facet[next[static_cast<std::size_t>(node)]++] = f;
  return result;
}

/// The area-weighted mean normal of the facets around a node that do not meet `own` at an edge.
Eigen::Vector3d smooth_normal(const FacetsOfNodes& around, const std::vector<Eigen::Vector3d>& area_vector,
                              std::size_t node, const Eigen::Vector3d& own) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = around.offset[node]; i < around.offset[node + 1]; ++i) {
    const Eigen::Vector3d& other = area_vector[around.facet[i]];
    if (other.dot(own) >= cosine_of_edge * other.norm() * own.norm()) sum += other;
  }
  return sum.normalized();
}

} // namespace

ShownField shown_field(const Snapshot& snapshot, const std::string& name) {
  if (name == "damage") {
    const Field& field = snapshot.node_field(name);
    ShownField shown{name, field.unit, {field.values.begin(), field.values.end()}, true};
    for (double& value : shown.value)
      if (value < 0) value = no_value;
    return shown;
  }
  const Field& field = snapshot.tet_field(name);
  ShownField shown{name, field.unit, std::vector<double>(snapshot.nodes(), 0.0), false};
  std::vector<double> volume(snapshot.nodes(), 0.0);
  for (std::size_t t = 0; t < snapshot.tets(); ++t) {
    const std::int32_t* node = snapshot.tet.data() + 4 * t;
    const double of_tet = std::abs(tet_geometry(snapshot, t).volume);
    for (std::size_t c = 0; c < 4; ++c) {
      shown.value[static_cast<std::size_t>(node[c])] += of_tet * static_cast<double>(field.values[t]);
      volume[static_cast<std::size_t>(node[c])] += of_tet;
    }
  }
  for (std::size_t n = 0; n < volume.size(); ++n)
    shown.value[n] = volume[n] > 0 ? shown.value[n] / volume[n] : no_value;
  return shown;
}

std::vector<SolidTriangle> cut_solid(const Snapshot& snapshot, const ShownField& field, const CutAway& away) {
  std::vector<std::int32_t> all(snapshot.tets());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<SurfaceFacet> facets = surface_facets(snapshot, all);
  const std::vector<Eigen::Vector3d> area_vector = area_vectors(snapshot, facets);
  const FacetsOfNodes around = facets_of_nodes(snapshot.nodes(), facets);
  std::vector<SolidTriangle> triangles;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    Polygon polygon;
    for (const std::int32_t node : facets[f].node) {
      const auto n = static_cast<std::size_t>(node);
      polygon.push_back(
          {position_of(snapshot, node), smooth_normal(around, area_vector, n, area_vector[f]), field.value[n]});
    }
    add_surface(triangles, std::move(polygon), facets[f].grain, 0, away);
  }
  for (std::size_t cut = 0; cut < away.size(); ++cut)
    for (std::size_t t = 0; t < snapshot.tets(); ++t) {
      SolidVertex corner[4];
      for (std::size_t c = 0; c < 4; ++c) {
        const std::int32_t node = snapshot.tet[4 * t + c];
        corner[c] = {position_of(snapshot, node), Eigen::Vector3d::Zero(),
                     field.of_surface ? no_value : field.value[static_cast<std::size_t>(node)]};
      }
      add_cut(triangles, corner, snapshot.tet_grain[t], away, cut);
    }
  return triangles;
}

std::vector<SolidTriangle> cut_surface(const std::vector<SolidTriangle>& triangles, const CutAway& away) {
  std::vector<SolidTriangle> left;
  for (const SolidTriangle& t : triangles)
    add_surface(left, {t.corner[0], t.corner[1], t.corner[2]}, t.grain, t.face, away);
  return left;
}

} // namespace mpfem
