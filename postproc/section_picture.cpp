#include "postproc/section_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/damage_section.hpp"
#include "postproc/raster_picture.hpp"
#include "postproc/text_file.hpp"

namespace mpfem {

namespace {

/// Percentile (0 … 1) of the section's values, weighted by area.
double percentile(const std::vector<SectionPolygon>& polygons, const std::vector<float>& values, double fraction) {
  std::vector<std::pair<double, double>> value_area;
  double total = 0;
  for (const SectionPolygon& polygon : polygons) {
    const auto value = static_cast<double>(values[static_cast<std::size_t>(polygon.tet)]);
    if (!std::isfinite(value)) continue; // a failed run's last state may hold some
    value_area.emplace_back(value, area(polygon));
    total += value_area.back().second;
  }
  std::sort(value_area.begin(), value_area.end());
  double sum = 0;
  for (const auto& [value, part] : value_area)
    if ((sum += part) >= fraction * total) return value;
  return value_area.empty() ? 0.0 : value_area.back().first;
}

bool overlaps(const SectionPolygon& polygon, const View& view) {
  for (std::size_t k = 0; k < 2; ++k) {
    double low = polygon.corner[0][k], high = low;
    for (std::size_t i = 1; i < static_cast<std::size_t>(polygon.corners); ++i)
      low = std::min(low, polygon.corner[i][k]), high = std::max(high, polygon.corner[i][k]);
    if (!(high > view.low[k] && low < view.high[k])) return false;
  }
  return true;
}

} // namespace

void write_section_picture(const std::string& path, const Snapshot& snapshot, const PictureRequest& request) {
  const bool of_damage = request.field == "damage";
  const Field& field = of_damage ? snapshot.node_field(request.field) : snapshot.tet_field(request.field);
  std::vector<SectionPolygon> polygons = cut(snapshot, request.plane);
  const auto axis = static_cast<std::size_t>(request.plane.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (polygons.empty())
    throw InputError(fmt::format("the plane at {:g} mm cuts no grain; the box spans {:g} … {:g} mm along this axis",
                                 request.plane.position, snapshot.box_low[axis], snapshot.box_high[axis]));
  const View view = request.view.value_or(
      View{{snapshot.box_low[u], snapshot.box_low[v]}, {snapshot.box_high[u], snapshot.box_high[v]}});
  std::erase_if(polygons, [&](const SectionPolygon& polygon) { return !overlaps(polygon, view); });
  if (polygons.empty())
    throw InputError(fmt::format(
        "no grain is cut in the view {:g} … {:g}, {:g} … {:g} mm; the box spans {:g} … {:g}, {:g} … {:g} mm",
        view.low[0], view.high[0], view.low[1], view.high[1], snapshot.box_low[u], snapshot.box_high[u],
        snapshot.box_low[v], snapshot.box_high[v]));
  const bool of_grains = field.name == "grain";
  std::pair<double, double> range{0, 1};
  if (request.range)
    range = *request.range;
  else if (!of_grains && !of_damage)
    range = {std::min(0.0, percentile(polygons, field.values, 0.005)), percentile(polygons, field.values, 0.995)};
  if (!(range.second > range.first)) range.second = range.first + 1;

  const auto fraction = [&range](double value) { return (value - range.first) / (range.second - range.first); };
  constexpr Colour light_grey{232, 232, 232}, grey{140, 140, 140};
  std::vector<Colour> colour(snapshot.tets(), light_grey);
  Lines lines;
  lines.mesh = request.mesh_lines;
  if (of_damage) {
    lines.outline = grey;
    lines.band_pixels = std::max(1.0, 5 * request.pixels / 900.0);
    for (const BoundarySegment& s : cut_boundaries(snapshot, request.plane))
      if (s.damage_from >= 0)
        lines.bands.push_back({s.from, s.to, fraction(s.damage_from), fraction(s.damage_to), s.grain});
  } else {
    for (std::size_t t = 0; t < snapshot.tets(); ++t)
      colour[t] = of_grains ? grain_colour(snapshot.tet_grain[t])
                            : scale_colour(fraction(static_cast<double>(field.values[t])));
  }
  const Raster raster = draw_section(polygons, colour, snapshot.tet_grain, view, request.pixels, lines);
  constexpr const char* axis_name[] = {"x", "y", "z"};
  Frame2d frame{view, request.title, fmt::format("{} (mm)", axis_name[u]), fmt::format("{} (mm)", axis_name[v]),
                {},   request.pixels};
  if (frame.title.empty() && snapshot.relative_density > 0)
    frame.title = fmt::format("Relative density {:.3f}", snapshot.relative_density);
  if (!of_grains) {
    std::string label = of_damage                   ? "Damage of bonds (0 intact, 1 broken)"
                        : field.name == "von_mises" ? "von Mises stress"
                        : field.name == "pressure"  ? "Pressure"
                                                    : "Equivalent plastic strain";
    if (field.unit != "1") label += fmt::format(" ({})", field.unit);
    frame.bar = ColourBar{range, label};
  }
  write_raster_picture(path, raster, frame);
}

std::string section_csv(const Snapshot& snapshot, const std::vector<SectionPolygon>& polygons,
                        const std::string& field) {
  const Field& values = snapshot.tet_field(field);
  std::vector<Column> columns = {{"tet", "1", {}},     {"grain", "1", {}}, {field, values.unit, {}},
                                 {"area", "mm^2", {}}, {"u", "mm", {}},    {"v", "mm", {}}};
  for (const SectionPolygon& polygon : polygons) {
    double middle[2] = {0, 0};
    for (int i = 0; i < polygon.corners; ++i)
      for (std::size_t k = 0; k < 2; ++k) middle[k] += polygon.corner[static_cast<std::size_t>(i)][k] / polygon.corners;
    const auto tet = static_cast<std::size_t>(polygon.tet);
    const double row[] = {static_cast<double>(tet),
                          static_cast<double>(snapshot.tet_grain[tet]),
                          static_cast<double>(values.values[tet]),
                          area(polygon),
                          middle[0],
                          middle[1]};
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row[c]);
  }
  return csv_text(columns);
}

} // namespace mpfem
