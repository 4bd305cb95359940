#include "surfaces/flip_slivers.hpp"

#include <algorithm>

namespace mpfem {

namespace {

bool is_below(const TriangleMesh& mesh, std::size_t t, double least) {
  const Vector3<double> area = area_vector(mesh, t);
  return dot(area, area) < least * least;
}

double squared_length(const TriangleMesh& mesh, std::int32_t edge) {
  const auto t = static_cast<std::size_t>(edge / 3), k = static_cast<std::size_t>(edge % 3);
  const Vector3<double> way = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
  return dot(way, way);
}

std::int32_t longest_edge(const TriangleMesh& mesh, std::int32_t t) {
  return std::max({3 * t, 3 * t + 1, 3 * t + 2},
                  [&](std::int32_t a, std::int32_t b) { return squared_length(mesh, a) < squared_length(mesh, b); });
}

std::int32_t start_of(const TriangleMesh& mesh, std::int32_t edge) {
  return mesh.triangle[static_cast<std::size_t>(edge / 3)][static_cast<std::size_t>(edge % 3)];
}

/// Replaces the triangles a b c and b a d, which share the edge a b, by c a d and d b c. False where that gives no
/// valid triangles.
bool flip(TriangleMesh& mesh, std::vector<std::int32_t>& partner, std::int32_t ab) {
  const auto across = [&](std::int32_t edge) -> std::int32_t& { return partner[static_cast<std::size_t>(edge)]; };
  const std::int32_t ba = across(ab), t = ab / 3, u = ba / 3;
  const std::int32_t a = start_of(mesh, ab), b = start_of(mesh, ba);
  const std::int32_t c = start_of(mesh, edge_before(ab)), d = start_of(mesh, edge_before(ba));
  if (t == u || c == d) return false;
  const std::int32_t beyond_bc = across(next_edge(ab)), beyond_ca = across(edge_before(ab));
  const std::int32_t beyond_ad = across(next_edge(ba)), beyond_db = across(edge_before(ba));
  // If the two triangles share another edge, the corner between the two edges has no other triangles: no flip.
  for (const std::int32_t edge : {beyond_bc, beyond_ca, beyond_ad, beyond_db})
    if (edge / 3 == t || edge / 3 == u) return false;
  const auto join = [&](std::int32_t e, std::int32_t f) { across(e) = f, across(f) = e; };
  mesh.triangle[static_cast<std::size_t>(t)] = {c, a, d};
  mesh.triangle[static_cast<std::size_t>(u)] = {d, b, c};
  join(3 * t, beyond_ca), join(3 * t + 1, beyond_ad), join(3 * t + 2, 3 * u + 2);
  join(3 * u, beyond_db), join(3 * u + 1, beyond_bc);
  return true;
}

} // namespace

SliverFlips flip_slivers(TriangleMesh& mesh, std::vector<std::int32_t>& partner, double least) {
  // A flip can leave a sliver where corners of several triangles lie on one line; a row of them needs one pass each.
  constexpr int most_passes = 100;
  SliverFlips result;
  for (int pass = 0; pass < most_passes; ++pass) {
    std::size_t flipped = 0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
      if (is_below(mesh, t, least) && flip(mesh, partner, longest_edge(mesh, static_cast<std::int32_t>(t)))) ++flipped;
    result.flipped += flipped;
    if (flipped == 0) break;
  }
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
    if (is_below(mesh, t, least) && result.left++ == 0) result.example = static_cast<std::int32_t>(t);
  return result;
}

} // namespace mpfem
