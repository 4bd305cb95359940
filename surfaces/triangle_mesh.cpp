#include "surfaces/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace mpfem {

namespace {

/// An edge without its direction.
struct Segment {
  std::int32_t low, high; ///< vertices
  std::int32_t edge;
  bool forward; ///< the triangle runs from low to high
};

std::vector<Segment> sorted_segments(const TriangleMesh& mesh) {
  std::vector<Segment> segments;
  segments.reserve(3 * mesh.triangle.size());
  for (const auto& corner : mesh.triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({corner[k], corner[(k + 1) % 3]});
      segments.push_back({low, high, static_cast<std::int32_t>(segments.size()), corner[k] == low});
    }
  std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) {
    return std::pair(a.low, a.high) != std::pair(b.low, b.high) ? std::pair(a.low, a.high) < std::pair(b.low, b.high)
                                                                : a.edge < b.edge;
  });
  return segments;
}

void note(EdgeFault& fault, std::int32_t edge) {
  if (fault.count++ == 0) fault.example = edge;
}

/// Pairs the triangles' edges that lie on one segment.
void pair_on_segment(std::span<const Segment> on, EdgePairs& pairs) {
  if (on.size() == 1) return note(pairs.open, on[0].edge);
  if (on.size() > 2) return note(pairs.non_manifold, on[0].edge);
  if (on[0].forward == on[1].forward) return note(pairs.misoriented, on[0].edge);
  pairs.partner[static_cast<std::size_t>(on[0].edge)] = on[1].edge;
  pairs.partner[static_cast<std::size_t>(on[1].edge)] = on[0].edge;
}

} // namespace

EdgePairs pair_edges(const TriangleMesh& mesh) {
  const std::vector<Segment> segments = sorted_segments(mesh);
  EdgePairs pairs;
  pairs.partner.assign(segments.size(), -1);
  for (std::size_t begin = 0, end = 0; begin < segments.size(); begin = end) {
    while (end < segments.size() && segments[end].low == segments[begin].low &&
           segments[end].high == segments[begin].high)
      ++end;
    pair_on_segment(std::span(segments).subspan(begin, end - begin), pairs);
  }
  return pairs;
}

std::vector<std::int32_t> shells(const std::vector<std::int32_t>& partner) {
  std::vector<std::int32_t> shell(partner.size() / 3, -1), waiting;
  std::int32_t count = 0;
  for (std::size_t first = 0; first < shell.size(); ++first) {
    if (shell[first] >= 0) continue;
    shell[first] = count;
    waiting.push_back(static_cast<std::int32_t>(first));
    while (!waiting.empty()) {
      const auto t = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t other = partner[3 * t + k] / 3;
        if (std::exchange(shell[static_cast<std::size_t>(other)], count) < 0) waiting.push_back(other);
      }
    }
    ++count;
  }
  return shell;
}

std::vector<std::int32_t> corner_fans(const std::vector<std::int32_t>& partner) {
  std::vector<std::int32_t> fan(partner.size(), -1);
  std::int32_t count = 0;
  for (std::size_t first = 0; first < fan.size(); ++first) {
    if (fan[first] >= 0) continue;
    // The partner of the edge that leaves the corner arrives there; the edge after it leaves the corner in the next
    // triangle.
    for (auto corner = first; fan[corner] < 0; corner = static_cast<std::size_t>(next_edge(partner[corner])))
      fan[corner] = count;
    ++count;
  }
  return fan;
}

Bounds bounds_of(const TriangleMesh& mesh) {
  const Vector3<double>& first = mesh.vertex.front();
  Bounds bounds{{first.x, first.y, first.z}, {first.x, first.y, first.z}};
  for (const Vector3<double>& v : mesh.vertex) {
    const std::array<double, 3> x{v.x, v.y, v.z};
    for (std::size_t a = 0; a < 3; ++a) {
      bounds.low[a] = std::min(bounds.low[a], x[a]);
      bounds.high[a] = std::max(bounds.high[a], x[a]);
    }
  }
  return bounds;
}

double diagonal(const Bounds& bounds) {
  return std::hypot(bounds.high[0] - bounds.low[0], bounds.high[1] - bounds.low[1], bounds.high[2] - bounds.low[2]);
}

Vector3<double> area_vector(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c) {
  const Vector3<double> ab = b - a, bc = c - b, ca = a - c;
  const double lab = dot(ab, ab), lbc = dot(bc, bc), lca = dot(ca, ca);
  if (lab >= lbc && lab >= lca) return 0.5 * cross(bc, ca);
  return 0.5 * (lbc >= lca ? cross(ca, ab) : cross(ab, bc));
}

double volume_share(const TriangleMesh& mesh, std::size_t t, const Vector3<double>& apex) {
  const Vector3<double> a = mesh.corner(t, 0) - apex, b = mesh.corner(t, 1) - apex, c = mesh.corner(t, 2) - apex;
  return dot(a, cross(b, c)) / 6;
}

double winding_share(const TriangleMesh& mesh, std::size_t t, const Vector3<double>& point) {
  const Vector3<double> a = mesh.corner(t, 0) - point, b = mesh.corner(t, 1) - point, c = mesh.corner(t, 2) - point;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return std::atan2(dot(a, cross(b, c)), below) / (2 * M_PI);
}

} // namespace mpfem
