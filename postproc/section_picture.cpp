#include "postproc/section_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/gnuplot.hpp"
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
  const Field& field = snapshot.tet_field(request.field);
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
  else if (!of_grains)
    range = {std::min(0.0, percentile(polygons, field.values, 0.005)), percentile(polygons, field.values, 0.995)};
  if (!(range.second > range.first)) range.second = range.first + 1;

  std::vector<Colour> colour(snapshot.tets());
  for (std::size_t t = 0; t < snapshot.tets(); ++t)
    colour[t] = of_grains
                    ? grain_colour(snapshot.tet_grain[t])
                    : scale_colour((static_cast<double>(field.values[t]) - range.first) / (range.second - range.first));
  const Raster raster = draw_section(polygons, colour, snapshot.tet_grain, view, request.pixels, request.mesh_lines);
  std::string bytes;
  for (const Colour& pixel : raster.pixel) bytes.append(reinterpret_cast<const char*>(pixel.data()), 3);
  const ScratchFile data(bytes), picture("");

  constexpr const char* axis_name[] = {"x", "y", "z"};
  const std::string title = !request.title.empty() ? request.title
                            : snapshot.relative_density > 0
                                ? fmt::format("Relative density {:.3f}", snapshot.relative_density)
                                : "";
  const double pixel_width = (view.high[0] - view.low[0]) / raster.width,
               pixel_height = (view.high[1] - view.low[1]) / raster.height;
  // Margins in pixels, so that a pixel of the raster is one of the picture; with the text they grow with the picture,
  // so that a finer one looks the same in print.
  const double scale = std::max(0.6, request.pixels / 900.0);
  const auto scaled = [scale](int pixels) { return static_cast<int>(std::lround(scale * pixels)); };
  const int left = scaled(120), right = scaled(of_grains ? 40 : 190), bottom = scaled(90), top = scaled(55);
  const double width = left + raster.width + right, height = bottom + raster.height + top;
  std::string script = fmt::format("set terminal pngcairo size {},{} font 'Sans,{:.1f}' enhanced\nset output {}\n",
                                   width, height, 15 * scale, gnuplot_string(picture.path()));
  script += fmt::format("set title {} noenhanced\nset xlabel '{} (mm)'\nset ylabel '{} (mm)'\nset tics out "
                        "nomirror\nset border lw {:.2f}\n"
                        "set xrange [{}:{}]\nset yrange [{}:{}]\n",
                        gnuplot_string(title), axis_name[u], axis_name[v], 1.5 * scale, view.low[0], view.high[0],
                        view.low[1], view.high[1]);
  script += fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n",
      left / width, (left + raster.width) / width, bottom / height, (bottom + raster.height) / height);
  if (!of_grains) {
    script += "set palette defined (";
    constexpr int steps = 32;
    for (int i = 0; i <= steps; ++i) {
      const Colour c = scale_colour(static_cast<double>(i) / steps);
      script += fmt::format("{}{} '#{:02x}{:02x}{:02x}'", i ? ", " : "", i, c[0], c[1], c[2]);
    }
    std::string label = field.name == "von_mises"  ? "von Mises stress"
                        : field.name == "pressure" ? "Pressure"
                                                   : "Equivalent plastic strain";
    if (field.unit != "1") label += fmt::format(" ({})", field.unit);
    script += fmt::format(")\nset cbrange [{}:{}]\nset cblabel '{}'\nset colorbox\n", range.first, range.second, label);
  }
  script += "unset key\n";
  script += fmt::format(
      "plot {} binary array=({},{}) format='%uchar' flipy origin=({},{}) dx={} dy={} using 1:2:3 with rgbimage",
      gnuplot_string(data.path()), raster.width, raster.height, view.low[0] + 0.5 * pixel_width,
      view.low[1] + 0.5 * pixel_height, pixel_width, pixel_height);
  // A curve of nothing that carries the palette, so that the colour bar is drawn.
  script += of_grains ? "\n" : ", '-' using 1:2:3 with points pt 0 lc palette\n0 0 0\ne\n";
  script += "set output\n";
  run_gnuplot(script);
  const std::string png = picture.content();
  if (!png.starts_with("\x89PNG")) throw SimulationError("gnuplot made no PNG picture");
  write_file(path, png);
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
  std::vector<const Column*> pointers;
  for (const Column& column : columns) pointers.push_back(&column);
  return csv_text(pointers);
}

} // namespace mpfem
