#include "postproc/drawing/tool_body.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mpfem {

namespace {

using Vector = std::array<double, 3>;

constexpr double share_of_thickness = 0.12; // of the box's longest edge
constexpr int edge_chords = 8, sphere_chords = 60;

bool is_die(const ToolGeometry& tool) {
  return tool.shape == ToolKind::cylinder && tool.inside;
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// ------------------------------------------------------------------------------------------------ turned bodies

/// Appends an arc around `centre` between two angles (from the radial towards the axial direction, rad).
void add_arc(std::vector<ProfilePoint>& profile, const ProfilePoint& centre, double radius, double from, double to,
             int chords) {
  for (int i = 0; i <= chords; ++i) {
    const double angle = from + (to - from) * i / chords;
    // Puts poles exactly on the axis, in spite of rounding.
    const double across = std::abs(std::cos(angle)) < 1e-14 ? 0.0 : std::cos(angle);
    profile.push_back({centre.radius + radius * across, centre.along + radius * std::sin(angle)});
  }
}

/// An interval along an axis, relative to the tool's point; true_…: that end is the tool's own, not the extent's.
struct AxialPart {
  double low, high;
  bool true_low, true_high;
};

AxialPart axial_part(const ToolGeometry& tool, std::size_t axis, const DrawnExtent& extent) {
  const double low = extent.low[axis] - tool.point[axis], high = extent.high[axis] - tool.point[axis];
  return {std::max(low, -tool.half_length), std::min(high, tool.half_length), -tool.half_length >= low,
          tool.half_length <= high};
}

/// The cross-section of a die's or a rod's solid, with rounded edges at the ends that are drawn.
std::optional<Revolved> cylinder_body(const ToolGeometry& tool, const DrawnExtent& extent) {
  const AxialPart part = axial_part(tool, tool.axis(), extent);
  if (!(part.high > part.low)) return {};
  const double r = tool.rounding, side = tool.inside ? 1 : -1; // direction of the solid from the surface
  const double back = tool.inside ? tool.radius + std::max(extent.thickness, 1.5 * r) : 0.0;
  std::vector<ProfilePoint> profile{{back, part.low}};
  const auto add_end = [&](double along, double outward, bool rounded) {
    if (!rounded || r <= 0) return profile.push_back({tool.radius, along});
    const ProfilePoint centre{tool.radius + side * r, along - outward * r};
    const double end = outward * M_PI / 2, across = tool.inside ? outward * M_PI : 0.0;
    // Upwards: the lower edge from its end face to the surface, the upper one from the surface to its end face.
    add_arc(profile, centre, r, outward < 0 ? end : across, outward < 0 ? across : end, edge_chords);
  };
  add_end(part.low, -1, part.true_low);
  add_end(part.high, 1, part.true_high);
  profile.push_back({back, part.high});
  return Revolved{tool.axis(), tool.point, std::move(profile)};
}

Revolved sphere_body(const ToolGeometry& tool, const DrawnExtent& extent) {
  Revolved body{2, tool.point, {}, tool.inside};
  add_arc(body.profile, {}, tool.radius, -M_PI / 2, M_PI / 2, sphere_chords);
  if (tool.inside) add_arc(body.profile, {}, tool.radius + extent.thickness, M_PI / 2, -M_PI / 2, sphere_chords);
  return body;
}

std::optional<Revolved> cone_body(const ToolGeometry& tool, const DrawnExtent& extent) {
  const std::size_t axis = tool.axis();
  const double sign = tool.direction[axis] < 0 ? -1 : 1;
  const double low = extent.low[axis] - tool.point[axis], high = extent.high[axis] - tool.point[axis];
  const double from = std::max(0.0, sign < 0 ? -high : low), to = sign < 0 ? -low : high; // towards the opening
  if (!(to > from)) return {};
  const double slope = std::tan(tool.half_angle);
  const double back = tool.inside ? extent.thickness / std::cos(tool.half_angle) : 0.0;
  const auto behind = [&](double along) { return tool.inside ? slope * along + back : 0.0; };
  return Revolved{
      axis,
      tool.point,
      {{slope * from, sign * from}, {slope * to, sign * to}, {behind(to), sign * to}, {behind(from), sign * from}}};
}

/// A plane normal to the axis of a die: a punch that fills the bore.
std::optional<Revolved> punch_body(const ToolGeometry& plane, const ToolGeometry& die, const DrawnExtent& extent) {
  const std::size_t axis = die.axis();
  const double outward = plane.direction[axis] > 0 ? -1 : 1, face = plane.point[axis];
  const double back = outward < 0 ? std::min(extent.low[axis], face - extent.thickness)
                                  : std::max(extent.high[axis], face + extent.thickness);
  Vector centre = die.point;
  centre[axis] = face;
  const double length = back - face;
  return Revolved{axis, centre, {{0, 0}, {die.radius, 0}, {die.radius, length}, {0, length}}};
}

// ------------------------------------------------------------------------------------------------ slabs

/// The convex polygon in which a plane cuts the extent, counter-clockwise seen from the normal's side: a large square
/// in the plane, clipped by the six sides (Sutherland and Hodgman 1974).
std::vector<Vector> plane_in_extent(const ToolGeometry& plane, const DrawnExtent& extent) {
  const Vector& n = plane.direction;
  Vector middle{}, first{};
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = 0.5 * (extent.low[k] + extent.high[k]);
    reach += extent.high[k] - extent.low[k];
  }
  Vector from_point{};
  for (std::size_t k = 0; k < 3; ++k) from_point[k] = middle[k] - plane.point[k];
  const double height = dot(n, from_point);
  for (std::size_t k = 0; k < 3; ++k) middle[k] -= height * n[k];
  const std::size_t least = static_cast<std::size_t>(
      std::min_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - n.begin());
  for (std::size_t k = 0; k < 3; ++k) first[k] = (k == least ? 1.0 : 0.0) - n[least] * n[k];
  const double length = std::sqrt(dot(first, first));
  for (double& c : first) c /= length;
  const Vector second{n[1] * first[2] - n[2] * first[1], n[2] * first[0] - n[0] * first[2],
                      n[0] * first[1] - n[1] * first[0]};
  std::vector<Vector> polygon;
  for (const auto& [u, v] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    Vector x = middle;
    for (std::size_t k = 0; k < 3; ++k) x[k] += reach * (u * first[k] + v * second[k]);
    polygon.push_back(x);
  }
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t k = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1, limit = side % 2 == 0 ? extent.low[k] : extent.high[k];
    std::vector<Vector> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double here = sign * (a[k] - limit), next = sign * (b[k] - limit);
      if (here >= 0) kept.push_back(a);
      if ((here >= 0) == (next >= 0)) continue;
      Vector crossing{};
      for (std::size_t c = 0; c < 3; ++c) crossing[c] = a[c] + here / (here - next) * (b[c] - a[c]);
      crossing[k] = limit;
      kept.push_back(crossing);
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// A plane's slab: its polygon, and the same polygon behind it.
std::optional<Faceted> slab_body(const ToolGeometry& plane, const DrawnExtent& extent) {
  Faceted body;
  body.vertex = plane_in_extent(plane, extent);
  const std::size_t n = body.front = body.vertex.size();
  if (n < 3) return {};
  for (std::size_t i = 0; i < n; ++i) {
    Vector x = body.vertex[i];
    for (std::size_t k = 0; k < 3; ++k) x[k] -= extent.thickness * plane.direction[k];
    body.vertex.push_back(x);
  }
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    body.triangle.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  };
  for (std::size_t i = 2; i < n; ++i) add(0, i - 1, i), add(n, n + i, n + i - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    add(i, n + i, n + next), add(i, n + next, next);
  }
  return body;
}

/// The die whose axis is normal to the plane; null where none is in place.
const ToolGeometry* die_of(const ToolGeometry& plane, const std::vector<ToolGeometry>& tools) {
  for (const ToolGeometry& tool : tools)
    if (is_die(tool) && std::abs(std::abs(plane.direction[tool.axis()]) - 1) < 1e-9) return &tool;
  return nullptr;
}

std::optional<Revolved> turned_body(const ToolGeometry& tool, const Snapshot& snapshot, const DrawnExtent& extent) {
  switch (tool.shape) {
  case ToolKind::cylinder:
    return cylinder_body(tool, extent);
  case ToolKind::sphere:
    return sphere_body(tool, extent);
  case ToolKind::cone:
    return cone_body(tool, extent);
  case ToolKind::plane:
    if (const ToolGeometry* die = die_of(tool, snapshot.tools)) return punch_body(tool, *die, extent);
    return {};
  case ToolKind::triangles:
    break;
  }
  return {};
}

std::optional<Faceted> faceted_body(const ToolGeometry& tool, const Snapshot& snapshot, const DrawnExtent& extent) {
  if (tool.shape == ToolKind::triangles) return Faceted{tool.vertex, tool.triangle};
  if (tool.shape == ToolKind::plane && die_of(tool, snapshot.tools) == nullptr) return slab_body(tool, extent);
  return {};
}

} // namespace

DrawnExtent drawn_extent(const Snapshot& snapshot) {
  DrawnExtent extent{snapshot.box_low, snapshot.box_high};
  Vector length{};
  for (std::size_t k = 0; k < 3; ++k) length[k] = snapshot.box_high[k] - snapshot.box_low[k];
  for (std::size_t i = 0; i < snapshot.node.size(); ++i) {
    const std::size_t k = i % 3;
    const double x = std::clamp(static_cast<double>(snapshot.node[i]), snapshot.box_low[k] - 0.3 * length[k],
                                snapshot.box_high[k] + 0.3 * length[k]);
    extent.low[k] = std::min(extent.low[k], x);
    extent.high[k] = std::max(extent.high[k], x);
  }
  const double longest = std::max({length[0], length[1], length[2]});
  for (const ToolGeometry& tool : snapshot.tools) {
    if (!is_die(tool)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double reach = k == tool.axis() ? tool.half_length : tool.radius;
      const double low = tool.point[k] - reach, high = tool.point[k] + reach;
      if (low > snapshot.box_low[k] - longest) extent.low[k] = std::min(extent.low[k], low);
      if (high < snapshot.box_high[k] + longest) extent.high[k] = std::max(extent.high[k], high);
    }
  }
  extent.thickness = share_of_thickness * longest;
  for (std::size_t k = 0; k < 3; ++k) extent.low[k] -= extent.thickness, extent.high[k] += extent.thickness;
  return extent;
}

std::vector<ToolBody> tool_bodies(const Snapshot& snapshot, const DrawnExtent& extent) {
  std::vector<ToolBody> bodies;
  for (const ToolGeometry& tool : snapshot.tools) {
    if (auto turned = turned_body(tool, snapshot, extent))
      bodies.push_back({tool.name, std::move(*turned), {}});
    else if (auto faceted = faceted_body(tool, snapshot, extent))
      bodies.push_back({tool.name, {}, std::move(*faceted)});
  }
  return bodies;
}

} // namespace mpfem
