#include "postproc/drawing/damage_section.hpp"

#include <cmath>

#include "postproc/files/text_file.hpp"
#include "postproc/run_data/surface_facets.hpp"

namespace mpfem {

std::vector<BoundarySegment> cut_boundaries(const Snapshot& snapshot, const CutPlane& plane) {
  const Field& damage = snapshot.node_field("damage");
  const auto axis = static_cast<std::size_t>(plane.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto coordinate = [&](std::int32_t node, std::size_t k) {
    return static_cast<double>(snapshot.node[3 * static_cast<std::size_t>(node) + k]);
  };
  const auto is_below = [&](std::int32_t node) { return coordinate(node, axis) - plane.position < 0; };
  // A facet that the plane cuts belongs to cut tets only, so the outer facets of these tets are outer facets of the
  // grain.
  std::vector<std::int32_t> tets;
  for (const SectionPolygon& polygon : cut(snapshot, plane)) tets.push_back(polygon.tet);
  std::vector<BoundarySegment> segments;
  for (const SurfaceFacet& facet : surface_facets(snapshot, tets)) {
    std::array<std::array<double, 2>, 2> point{};
    std::array<double, 2> value{};
    std::size_t points = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = facet.node[i], b = facet.node[(i + 1) % 3];
      if (is_below(a) == is_below(b)) continue;
      const double from = coordinate(a, axis) - plane.position, to = coordinate(b, axis) - plane.position;
      const double w = from / (from - to);
      point[points] = {coordinate(a, u) + w * (coordinate(b, u) - coordinate(a, u)),
                       coordinate(a, v) + w * (coordinate(b, v) - coordinate(a, v))};
      const auto damage_a = static_cast<double>(damage.values[static_cast<std::size_t>(a)]),
                 damage_b = static_cast<double>(damage.values[static_cast<std::size_t>(b)]);
      value[points++] =
          damage_a >= 0 && damage_b >= 0 ? damage_a + w * (damage_b - damage_a) : (w < 0.5 ? damage_a : damage_b);
    }
    if (points < 2) continue;
    if ((value[0] >= 0) == (value[1] >= 0)) {
      segments.push_back({point[0], point[1], value[0], value[1], facet.grain});
      continue;
    }
    const std::array<double, 2> middle = {0.5 * (point[0][0] + point[1][0]), 0.5 * (point[0][1] + point[1][1])};
    segments.push_back({point[0], middle, value[0], value[0], facet.grain});
    segments.push_back({middle, point[1], value[1], value[1], facet.grain});
  }
  return segments;
}

std::string damage_section_csv(const std::vector<BoundarySegment>& segments) {
  std::vector<Column> columns = {{"grain", "1", {}},    {"u_1", "mm", {}},    {"v_1", "mm", {}},
                                 {"u_2", "mm", {}},     {"v_2", "mm", {}},    {"length", "mm", {}},
                                 {"damage_1", "1", {}}, {"damage_2", "1", {}}};
  for (const BoundarySegment& s : segments) {
    const double row[] = {static_cast<double>(s.grain),
                          s.from[0],
                          s.from[1],
                          s.to[0],
                          s.to[1],
                          std::hypot(s.to[0] - s.from[0], s.to[1] - s.from[1]),
                          s.damage_from,
                          s.damage_to};
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row[c]);
  }
  return csv_text(columns);
}

} // namespace mpfem
