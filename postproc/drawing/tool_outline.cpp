#include "postproc/drawing/tool_outline.hpp"

#include <cmath>

namespace mpfem {

namespace {

using Point = std::array<double, 2>;

constexpr int circle_pieces = 360, bent_pieces = 16;

/// Circles where the profile's edges cross the height of the plane.
std::vector<OutlinePiece> across_axis(const Revolved& body, double height) {
  const std::size_t u = (body.axis + 1) % 3, v = (body.axis + 2) % 3;
  const auto on_circle = [&](double radius, int piece) {
    const double angle = 2 * M_PI * (piece % circle_pieces) / circle_pieces;
    return Point{body.centre[u] + radius * std::cos(angle), body.centre[v] + radius * std::sin(angle)};
  };
  std::vector<OutlinePiece> pieces;
  for (std::size_t i = 0; i < body.profile.size(); ++i) {
    const ProfilePoint &a = body.profile[i], &b = body.profile[(i + 1) % body.profile.size()];
    if ((a.along < height) == (b.along < height)) continue;
    const double radius = a.radius + (height - a.along) / (b.along - a.along) * (b.radius - a.radius);
    if (!(radius > 0)) continue; // on the axis
    for (int piece = 0; piece < circle_pieces; ++piece)
      pieces.push_back({on_circle(radius, piece), on_circle(radius, piece + 1)});
  }
  return pieces;
}

/// The part of a profile that is at least `distance` from the axis.
std::vector<ProfilePoint> beyond(const std::vector<ProfilePoint>& profile, double distance) {
  std::vector<ProfilePoint> kept;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const ProfilePoint &a = profile[i], &b = profile[(i + 1) % profile.size()];
    const double here = a.radius - distance, next = b.radius - distance;
    if (here >= 0) kept.push_back(a);
    if ((here >= 0) != (next >= 0)) kept.push_back({distance, a.along + here / (here - next) * (b.along - a.along)});
  }
  return kept;
}

/// The profile on either side of the axis, its edges curved where the plane does not pass through the axis.
std::vector<OutlinePiece> along_axis(const Revolved& body, const CutPlane& plane) {
  const auto normal = static_cast<std::size_t>(plane.axis);
  const bool axis_first = (normal + 1) % 3 == body.axis; // of the plane's two coordinates
  const std::size_t other = 3 - normal - body.axis;
  const double distance = std::abs(plane.position - body.centre[normal]);
  const std::vector<ProfilePoint> profile = beyond(body.profile, distance);
  const auto place = [&](const ProfilePoint& p, double side) {
    const double across =
        body.centre[other] + side * std::sqrt(std::max(0.0, p.radius * p.radius - distance * distance));
    const double along = body.centre[body.axis] + p.along;
    return axis_first ? Point{along, across} : Point{across, along};
  };
  std::vector<OutlinePiece> pieces;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const ProfilePoint &a = profile[i], &b = profile[(i + 1) % profile.size()];
    if (a.radius <= distance && b.radius <= distance) continue; // on the line where both sides meet
    const int parts = distance > 0 && a.radius != b.radius ? bent_pieces : 1;
    const auto part = [&](int k) {
      if (k == parts) return b; // exactly
      const double w = static_cast<double>(k) / parts;
      return ProfilePoint{a.radius + w * (b.radius - a.radius), a.along + w * (b.along - a.along)};
    };
    for (int k = 0; k < parts; ++k)
      for (const double side : {1.0, -1.0}) pieces.push_back({place(part(k), side), place(part(k + 1), side)});
  }
  return pieces;
}

std::vector<OutlinePiece> of_triangles(const Faceted& body, const CutPlane& plane) {
  const auto axis = static_cast<std::size_t>(plane.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<OutlinePiece> pieces;
  for (const auto& triangle : body.triangle) {
    std::array<Point, 2> end{};
    std::size_t ends = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& a = body.vertex[static_cast<std::size_t>(triangle[i])];
      const auto& b = body.vertex[static_cast<std::size_t>(triangle[(i + 1) % 3])];
      const double here = a[axis] - plane.position, next = b[axis] - plane.position;
      if ((here < 0) == (next < 0)) continue;
      const double w = here / (here - next);
      end[ends++] = {a[u] + w * (b[u] - a[u]), a[v] + w * (b[v] - a[v])};
    }
    if (ends == 2) pieces.push_back({end[0], end[1]});
  }
  return pieces;
}

} // namespace

std::vector<OutlinePiece> section_outline(const ToolBody& body, const CutPlane& plane) {
  if (!body.is_turned()) return of_triangles(body.faceted, plane);
  if (body.turned.axis == static_cast<std::size_t>(plane.axis))
    return across_axis(body.turned, plane.position - body.turned.centre[body.turned.axis]);
  return along_axis(body.turned, plane);
}

} // namespace mpfem
