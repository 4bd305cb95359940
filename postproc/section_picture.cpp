#include "postproc/section_picture.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/text_file.hpp"

namespace mpfem {

namespace {

constexpr int fineness = 3;          // each pixel is the mean of 3 x 3
constexpr double line_pixels = 0.67; // half width of the outlines, in pixels

/// A raster of tet numbers, -1 outside every tet; rows from the top.
struct TetRaster {
  int width, height;
  std::vector<std::int32_t> tet;
};

TetRaster rasterise(const std::vector<SectionPolygon>& polygons, const View& view, int width, int height) {
  TetRaster raster{width, height, std::vector<std::int32_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -1)};
  const double sx = width / (view.high[0] - view.low[0]), sy = height / (view.high[1] - view.low[1]);
  for (const SectionPolygon& polygon : polygons) {
    std::array<std::array<double, 2>, 4> p{};
    const auto corners = static_cast<std::size_t>(polygon.corners);
    double top = 1e300, bottom = -1e300;
    for (std::size_t i = 0; i < corners; ++i) {
      p[i] = {(polygon.corner[i][0] - view.low[0]) * sx, (view.high[1] - polygon.corner[i][1]) * sy};
      top = std::min(top, p[i][1]), bottom = std::max(bottom, p[i][1]);
    }
    const int first = static_cast<int>(std::clamp(std::ceil(top - 0.5), 0.0, static_cast<double>(height)));
    const int last = static_cast<int>(std::clamp(std::floor(bottom - 0.5), -1.0, height - 1.0));
    for (int row = first; row <= last; ++row) { // the convex polygon's span on the row through the pixels' centres
      const double y = row + 0.5;
      double left = 1e300, right = -1e300;
      for (std::size_t i = 0; i < corners; ++i) {
        const auto &a = p[i], &b = p[(i + 1) % corners];
        if ((a[1] <= y) == (b[1] <= y)) continue;
        const double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        left = std::min(left, x), right = std::max(right, x);
      }
      const int from = static_cast<int>(std::clamp(std::ceil(left - 0.5), 0.0, static_cast<double>(width)));
      const int to = static_cast<int>(std::clamp(std::floor(right - 0.5), -1.0, width - 1.0));
      for (int column = from; column <= to; ++column)
        raster.tet[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] = polygon.tet;
    }
  }
  return raster;
}

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

/// The text in single quotes, a quote inside replaced.
std::string quoted(const std::string& text, std::string_view inner_quote) {
  std::string result = "'";
  for (const char c : one_line(text)) {
    if (c == '\'') result += inner_quote;
    else result += c;
  }
  return result + "'";
}
// Single quotes, since gnuplot and the shell would both run `commands` inside double ones.
std::string for_gnuplot(const std::string& text) { return quoted(text, "''"); }
std::string for_shell(const std::string& text) { return quoted(text, "'\\''"); }

bool overlaps(const SectionPolygon& polygon, const View& view) {
  for (std::size_t k = 0; k < 2; ++k) {
    double low = polygon.corner[0][k], high = low;
    for (std::size_t i = 1; i < static_cast<std::size_t>(polygon.corners); ++i)
      low = std::min(low, polygon.corner[i][k]), high = std::max(high, polygon.corner[i][k]);
    if (!(high > view.low[k] && low < view.high[k])) return false;
  }
  return true;
}

/// A scratch file that goes away.
class ScratchFile {
public:
  explicit ScratchFile(const std::string& content) {
    path_ = (std::filesystem::temp_directory_path() / "mpfem-section-XXXXXX").string();
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) throw StorageError(fmt::format("{}: cannot be made", path_));
    std::FILE* file = fdopen(descriptor, "wb");
    const bool good = file && std::fwrite(content.data(), 1, content.size(), file) == content.size();
    if (!file || std::fclose(file) != 0 || !good) throw StorageError(fmt::format("{}: cannot be written", path_));
  }
  ~ScratchFile() { std::remove(path_.c_str()); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::string& path() const { return path_; }
  std::string content() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

private:
  std::string path_;
};

void run_gnuplot(const std::string& script) {
  const ScratchFile file(script);
  std::FILE* pipe = popen(fmt::format("gnuplot -d {} 2>&1", for_shell(file.path())).c_str(), "r");
  if (!pipe) throw SimulationError("gnuplot cannot be started");
  std::string message;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe)) message += buffer;
  const int status = pclose(pipe);
  if (status == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) throw SimulationError("gnuplot is not installed; pictures need it");
  throw SimulationError(fmt::format("gnuplot failed: {}", one_line(message.substr(0, 300))));
}

} // namespace

Raster draw_section(const std::vector<SectionPolygon>& polygons, const std::vector<Colour>& tet_colour,
                    const std::vector<std::int32_t>& tet_grain, const View& view, int pixels, bool mesh_lines) {
  const double extent[2] = {view.high[0] - view.low[0], view.high[1] - view.low[1]};
  const double size = std::max(extent[0], extent[1]) / pixels;
  Raster raster;
  raster.width = std::max(1, static_cast<int>(std::lround(extent[0] / size)));
  raster.height = std::max(1, static_cast<int>(std::lround(extent[1] / size)));
  const TetRaster fine = rasterise(polygons, view, fineness * raster.width, fineness * raster.height);
  const auto tet_at = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= fine.width || y >= fine.height) return std::int32_t{-1};
    return fine.tet[static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.width) + static_cast<std::size_t>(x)];
  };
  const auto grain_at = [&](int x, int y) {
    const std::int32_t tet = tet_at(x, y);
    return tet < 0 ? std::int32_t{-1} : tet_grain[static_cast<std::size_t>(tet)];
  };
  // A fine pixel is on a line where another grain, or none, lies within the line's half width.
  const int reach = std::max(1, static_cast<int>(std::lround(line_pixels * fineness)));
  constexpr Colour line{25, 25, 25}, mesh_line{90, 90, 90}, empty{255, 255, 255};
  raster.pixel.resize(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height));
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column) {
      std::array<int, 3> sum{};
      for (int j = 0; j < fineness; ++j)
        for (int i = 0; i < fineness; ++i) {
          const int x = column * fineness + i, y = row * fineness + j;
          const std::int32_t grain = grain_at(x, y);
          const std::int32_t tet = tet_at(x, y);
          bool edge = false;
          if (grain >= 0)
            for (const auto& [dx, dy] : {std::pair{reach, 0}, {-reach, 0}, {0, reach}, {0, -reach}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}})
              edge = edge || grain_at(x + dx, y + dy) != grain;
          const bool between_tets = mesh_lines && (tet_at(x + 1, y) != tet || tet_at(x, y + 1) != tet);
          const Colour& colour = edge ? line : grain >= 0 && between_tets ? mesh_line : grain >= 0 ? tet_colour[static_cast<std::size_t>(tet)] : empty;
          for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
        }
      Colour& pixel = raster.pixel[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(column)];
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(sum[c] / (fineness * fineness));
    }
  return raster;
}

void write_section_picture(const std::string& path, const Snapshot& snapshot, const PictureRequest& request) {
  const Field& field = snapshot.tet_field(request.field);
  std::vector<SectionPolygon> polygons = cut(snapshot, request.plane);
  const auto axis = static_cast<std::size_t>(request.plane.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (polygons.empty())
    throw InputError(fmt::format("the plane at {:g} mm cuts no grain; the box spans {:g} … {:g} mm along this axis", request.plane.position,
                                 snapshot.box_low[axis], snapshot.box_high[axis]));
  const View view = request.view.value_or(View{{snapshot.box_low[u], snapshot.box_low[v]}, {snapshot.box_high[u], snapshot.box_high[v]}});
  std::erase_if(polygons, [&](const SectionPolygon& polygon) { return !overlaps(polygon, view); });
  if (polygons.empty())
    throw InputError(fmt::format("no grain is cut in the view {:g} … {:g}, {:g} … {:g} mm; the box spans {:g} … {:g}, {:g} … {:g} mm", view.low[0],
                                 view.high[0], view.low[1], view.high[1], snapshot.box_low[u], snapshot.box_high[u], snapshot.box_low[v], snapshot.box_high[v]));
  const bool of_grains = field.name == "grain";
  std::pair<double, double> range{0, 1};
  if (request.range) range = *request.range;
  else if (!of_grains) range = {std::min(0.0, percentile(polygons, field.values, 0.005)), percentile(polygons, field.values, 0.995)};
  if (!(range.second > range.first)) range.second = range.first + 1;

  std::vector<Colour> colour(snapshot.tets());
  for (std::size_t t = 0; t < snapshot.tets(); ++t)
    colour[t] = of_grains ? grain_colour(snapshot.tet_grain[t])
                          : scale_colour((static_cast<double>(field.values[t]) - range.first) / (range.second - range.first));
  const Raster raster = draw_section(polygons, colour, snapshot.tet_grain, view, request.pixels, request.mesh_lines);
  std::string bytes;
  for (const Colour& pixel : raster.pixel) bytes.append(reinterpret_cast<const char*>(pixel.data()), 3);
  const ScratchFile data(bytes), picture("");

  constexpr const char* axis_name[] = {"x", "y", "z"};
  const std::string title = !request.title.empty() ? request.title
                            : snapshot.relative_density > 0 ? fmt::format("Relative density {:.3f}", snapshot.relative_density) : "";
  const double pixel_width = (view.high[0] - view.low[0]) / raster.width, pixel_height = (view.high[1] - view.low[1]) / raster.height;
  // Margins in pixels, so that a pixel of the raster is one of the picture.
  const int left = 120, right = of_grains ? 40 : 190, bottom = 90, top = 55;
  const double width = left + raster.width + right, height = bottom + raster.height + top;
  std::string script = fmt::format("set terminal pngcairo size {},{} font 'Sans,15' enhanced\nset output {}\n", width, height, for_gnuplot(picture.path()));
  script += fmt::format("set title {} noenhanced\nset xlabel '{} (mm)'\nset ylabel '{} (mm)'\nset tics out nomirror\nset border lw 1.5\n"
                        "set xrange [{}:{}]\nset yrange [{}:{}]\n",
                        for_gnuplot(title), axis_name[u], axis_name[v], view.low[0], view.high[0], view.low[1], view.high[1]);
  script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n", left / width,
                        (left + raster.width) / width, bottom / height, (bottom + raster.height) / height);
  if (!of_grains) {
    script += "set palette defined (";
    constexpr int steps = 32;
    for (int i = 0; i <= steps; ++i) {
      const Colour c = scale_colour(static_cast<double>(i) / steps);
      script += fmt::format("{}{} '#{:02x}{:02x}{:02x}'", i ? ", " : "", i, c[0], c[1], c[2]);
    }
    std::string label = field.name == "von_mises" ? "von Mises stress" : field.name == "pressure" ? "Pressure" : "Equivalent plastic strain";
    if (field.unit != "1") label += fmt::format(" ({})", field.unit);
    script += fmt::format(")\nset cbrange [{}:{}]\nset cblabel '{}'\nset colorbox\n", range.first, range.second, label);
  }
  script += "unset key\n";
  script += fmt::format("plot {} binary array=({},{}) format='%uchar' flipy origin=({},{}) dx={} dy={} using 1:2:3 with rgbimage",
                        for_gnuplot(data.path()), raster.width, raster.height, view.low[0] + 0.5 * pixel_width, view.low[1] + 0.5 * pixel_height, pixel_width, pixel_height);
  // A curve of nothing that carries the palette, so that the colour bar is drawn.
  script += of_grains ? "\n" : ", '-' using 1:2:3 with points pt 0 lc palette\n0 0 0\ne\n";
  script += "set output\n";
  run_gnuplot(script);
  const std::string png = picture.content();
  if (!png.starts_with("\x89PNG")) throw SimulationError("gnuplot made no PNG picture");
  write_file(path, png);
}

std::string section_csv(const Snapshot& snapshot, const std::vector<SectionPolygon>& polygons, const std::string& field) {
  const Field& values = snapshot.tet_field(field);
  std::vector<Column> columns = {{"tet", "1", {}}, {"grain", "1", {}}, {field, values.unit, {}}, {"area", "mm^2", {}}, {"u", "mm", {}}, {"v", "mm", {}}};
  for (const SectionPolygon& polygon : polygons) {
    double middle[2] = {0, 0};
    for (int i = 0; i < polygon.corners; ++i)
      for (std::size_t k = 0; k < 2; ++k) middle[k] += polygon.corner[static_cast<std::size_t>(i)][k] / polygon.corners;
    const auto tet = static_cast<std::size_t>(polygon.tet);
    const double row[] = {static_cast<double>(tet), static_cast<double>(snapshot.tet_grain[tet]), static_cast<double>(values.values[tet]), area(polygon), middle[0], middle[1]};
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row[c]);
  }
  std::vector<const Column*> pointers;
  for (const Column& column : columns) pointers.push_back(&column);
  return csv_text(pointers);
}

} // namespace mpfem
