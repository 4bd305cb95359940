#include "postproc/drawing/section_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/drawing/damage_section.hpp"
#include "postproc/drawing/field_display.hpp"
#include "postproc/drawing/raster_picture.hpp"
#include "postproc/files/text_file.hpp"

namespace mpfem {

namespace {

/// The values on a section and their areas (mm^2).
std::vector<std::pair<double, double>> values_and_areas(const std::vector<SectionPolygon>& polygons,
                                                        const std::vector<float>& values) {
  std::vector<std::pair<double, double>> parts;
  for (const SectionPolygon& polygon : polygons)
    parts.emplace_back(values[static_cast<std::size_t>(polygon.tet)], area(polygon));
  return parts;
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

/// The smallest view of all polygons; there is at least one.
View extent_of(const std::vector<SectionPolygon>& polygons) {
  View view{polygons.front().corner[0], polygons.front().corner[0]};
  for (const SectionPolygon& polygon : polygons)
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.corners); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        view.low[k] = std::min(view.low[k], polygon.corner[i][k]);
        view.high[k] = std::max(view.high[k], polygon.corner[i][k]);
      }
  return view;
}

std::string text_of(const View& view) {
  return fmt::format("{:g} … {:g}, {:g} … {:g} mm", view.low[0], view.high[0], view.low[1], view.high[1]);
}

/// The polygons of a section that the view shows.
struct VisibleSection {
  View view;
  std::vector<SectionPolygon> polygons;
};

bool draws_tools(const Snapshot& snapshot, const PictureRequest& request) {
  return request.tools && !snapshot.tools.empty();
}

/// Throws InputError where there are none.
VisibleSection visible_section(const Snapshot& snapshot, const PictureRequest& request) {
  std::vector<SectionPolygon> polygons = cut_grains(snapshot, request.plane);
  const auto axis = static_cast<std::size_t>(request.plane.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto &low = snapshot.box_low, &high = snapshot.box_high;
  View view{{low[u], low[v]}, {high[u], high[v]}};
  if (draws_tools(snapshot, request)) {
    const DrawnExtent extent = drawn_extent(snapshot);
    view = {{extent.low[u], extent.low[v]}, {extent.high[u], extent.high[v]}};
  }
  view = request.view.value_or(view);
  const View of_all = extent_of(polygons);
  std::erase_if(polygons, [&](const SectionPolygon& polygon) { return !overlaps(polygon, view); });
  if (!polygons.empty()) return {view, std::move(polygons)};
  throw InputError(
      fmt::format("{}: no grain is cut in {}, allowed: a --view with some of the cut grains, which lie in {}",
                  request.view ? "--view" : fmt::format("snapshot {}", snapshot.name), text_of(view), text_of(of_all)));
}

/// The field of a snapshot that the colours show.
struct Shown {
  const Field& field;
  bool damage; ///< along the grains' boundaries
  bool grains; ///< their numbers, which have no scale
};

Shown shown_field(const Snapshot& snapshot, const std::string& name) {
  const bool damage = name == "damage";
  const Field& field = damage ? snapshot.node_field(name) : snapshot.tet_field(name);
  return {field, damage, field.name == "grain"};
}

/// A linear colour scale.
struct Scale {
  std::pair<double, double> range;
  double fraction(double value) const { return (value - range.first) / (range.second - range.first); }
};

Scale scale_of(const Shown& shown, const std::vector<SectionPolygon>& polygons, const PictureRequest& request) {
  std::pair<double, double> range{0, 1};
  if (request.range)
    range = *request.range;
  else if (!shown.grains && !shown.damage)
    range = colour_range(values_and_areas(polygons, shown.field.values));
  if (!(range.second > range.first)) range.second = range.first + 1;
  return {range};
}

std::vector<Colour> tet_colours(const Snapshot& snapshot, const Shown& shown, const Scale& scale) {
  constexpr Colour light_grey{232, 232, 232};
  std::vector<Colour> colour(snapshot.tets(), light_grey);
  if (shown.damage) return colour;
  for (std::size_t t = 0; t < snapshot.tets(); ++t)
    colour[t] = shown.grains ? grain_colour(snapshot.tet_grain[t])
                             : scale_colour(scale.fraction(static_cast<double>(shown.field.values[t])));
  return colour;
}

/// The tools, the tets' edges where requested, and for damage a band along each boundary that has been bonded.
Lines lines_over(const Snapshot& snapshot, const Shown& shown, const Scale& scale, const PictureRequest& request) {
  Lines lines;
  lines.mesh = request.mesh_lines;
  if (draws_tools(snapshot, request))
    for (const ToolBody& body : tool_bodies(snapshot, drawn_extent(snapshot)))
      lines.tools.push_back(section_outline(body, request.plane));
  if (!shown.damage) return lines;
  lines.outline = {140, 140, 140};
  lines.band_pixels = std::max(1.0, 5 * request.pixels / 900.0);
  for (const BoundarySegment& s : cut_boundaries(snapshot, request.plane))
    if (s.damage_from >= 0)
      lines.bands.push_back({s.from, s.to, scale.fraction(s.damage_from), scale.fraction(s.damage_to), s.grain});
  return lines;
}

std::string label_of(const Shown& shown) {
  const std::string& name = shown.field.name;
  return with_unit(shown.damage ? "Damage of bonds (0 intact, 1 broken)" : field_label(name), shown.field.unit);
}

ColourBar bar_of(const Shown& shown, const Scale& scale, const std::vector<SectionPolygon>& polygons,
                 const Lines& lines) {
  ColourBar bar{scale.range, label_of(shown)};
  if (!shown.damage)
    for (const SectionPolygon& polygon : polygons)
      bar.add(static_cast<double>(shown.field.values[static_cast<std::size_t>(polygon.tet)]));
  const double length = scale.range.second - scale.range.first;
  for (const Band& band : lines.bands) // which have fractions of the scale
    for (const double fraction : {band.value_from, band.value_to}) bar.add(scale.range.first + fraction * length);
  return bar;
}

/// The picture's frame.
Frame2d frame_of(const Snapshot& snapshot, const View& view, const PictureRequest& request) {
  constexpr const char* axis_name[] = {"x", "y", "z"};
  const auto axis = static_cast<std::size_t>(request.plane.axis);
  const auto label = [&](std::size_t k) { return fmt::format("{} (mm)", axis_name[(axis + k) % 3]); };
  Frame2d frame{view, request.title, label(1), label(2), {}, request.pixels};
  if (frame.title.empty() && snapshot.relative_density > 0)
    frame.title = fmt::format("Relative density {:.3f}", snapshot.relative_density);
  return frame;
}

} // namespace

void write_section_picture(const std::string& path, const Snapshot& snapshot, const PictureRequest& request) {
  const Shown shown = shown_field(snapshot, request.field);
  const VisibleSection section = visible_section(snapshot, request);
  const Scale scale = scale_of(shown, section.polygons, request);
  const Lines lines = lines_over(snapshot, shown, scale, request);
  const Raster raster = draw_section(section.polygons, tet_colours(snapshot, shown, scale), snapshot.tet_grain,
                                     section.view, request.pixels, lines);
  Frame2d frame = frame_of(snapshot, section.view, request);
  if (!shown.grains) frame.bar = bar_of(shown, scale, section.polygons, lines);
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
