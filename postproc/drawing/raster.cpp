#include "postproc/drawing/raster.hpp"

#include <algorithm>
#include <cmath>

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
  TetRaster raster{width, height,
                   std::vector<std::int32_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -1)};
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
    for (int row = first; row <= last; ++row) { // span of the convex polygon on the line through the pixels' centres
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
        raster.tet[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] =
            polygon.tet;
    }
  }
  return raster;
}

/// Colour of the grain's nearest band at every fine pixel within the band's width; `painted` where there is one.
struct BandRaster {
  std::vector<Colour> colour;
  std::vector<bool> painted;
};

BandRaster paint_bands(const Lines& lines, const TetRaster& fine, const std::vector<std::int32_t>& tet_grain,
                       const View& view) {
  BandRaster raster;
  if (lines.bands.empty()) return raster;
  raster.colour.resize(fine.tet.size());
  raster.painted.resize(fine.tet.size());
  const double reach = lines.band_pixels * fineness;
  std::vector<float> nearest(fine.tet.size(), static_cast<float>(reach * reach));
  const double sx = fine.width / (view.high[0] - view.low[0]), sy = fine.height / (view.high[1] - view.low[1]);
  const auto pixel_range = [reach](double a, double b, int size) {
    const double low = std::floor(std::min(a, b) - reach), high = std::ceil(std::max(a, b) + reach);
    return std::pair{static_cast<int>(std::clamp(low, 0.0, static_cast<double>(size))),
                     static_cast<int>(std::clamp(high, 0.0, static_cast<double>(size)))};
  };
  for (const Band& band : lines.bands) {
    const double x0 = (band.from[0] - view.low[0]) * sx, y0 = (view.high[1] - band.from[1]) * sy;
    const double dx = (band.to[0] - band.from[0]) * sx, dy = (band.from[1] - band.to[1]) * sy;
    const double square = dx * dx + dy * dy;
    const auto [left, right] = pixel_range(x0, x0 + dx, fine.width);
    const auto [top, bottom] = pixel_range(y0, y0 + dy, fine.height);
    for (int row = top; row < bottom; ++row)
      for (int column = left; column < right; ++column) {
        const std::size_t at =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(fine.width) + static_cast<std::size_t>(column);
        const std::int32_t tet = fine.tet[at];
        if (tet < 0 || tet_grain[static_cast<std::size_t>(tet)] != band.grain) continue;
        const double x = column + 0.5 - x0, y = row + 0.5 - y0;
        const double w = square > 0 ? std::clamp((x * dx + y * dy) / square, 0.0, 1.0) : 0.0;
        const auto distance = static_cast<float>((x - w * dx) * (x - w * dx) + (y - w * dy) * (y - w * dy));
        if (!(distance < nearest[at])) continue;
        nearest[at] = distance;
        raster.colour[at] = scale_colour(band.value_from + w * (band.value_to - band.value_from));
        raster.painted[at] = true;
      }
  }
  return raster;
}

/// The number of the tool at every fine pixel, counted from 1; 0 where there is none.
std::vector<std::uint16_t> rasterise_tools(const std::vector<std::vector<OutlinePiece>>& tools, const View& view,
                                           int width, int height) {
  std::vector<std::uint16_t> number;
  if (tools.empty()) return number;
  number.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const double sx = width / (view.high[0] - view.low[0]), sy = height / (view.high[1] - view.low[1]);
  for (std::size_t tool = 0; tool < tools.size(); ++tool) {
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(height)); // with the middle line of each row
    for (const OutlinePiece& piece : tools[tool]) {
      const double x0 = (piece.from[0] - view.low[0]) * sx, y0 = (view.high[1] - piece.from[1]) * sy;
      const double x1 = (piece.to[0] - view.low[0]) * sx, y1 = (view.high[1] - piece.to[1]) * sy;
      const auto row_at = [&](double y) { return static_cast<int>(std::clamp(std::ceil(y - 0.5), 0.0, height * 1.0)); };
      const int first = row_at(std::min(y0, y1)), end = row_at(std::max(y0, y1));
      for (int row = first; row < end; ++row)
        crossings[static_cast<std::size_t>(row)].push_back(x0 + (row + 0.5 - y0) / (y1 - y0) * (x1 - x0));
    }
    for (std::size_t row = 0; row < crossings.size(); ++row) {
      std::vector<double>& x = crossings[row];
      std::sort(x.begin(), x.end());
      for (std::size_t i = 0; i + 1 < x.size(); i += 2) {
        const auto column_at = [&](double at) {
          return static_cast<std::ptrdiff_t>(std::clamp(std::ceil(at - 0.5), 0.0, width * 1.0));
        };
        const auto begin = number.begin() + static_cast<std::ptrdiff_t>(row) * width;
        std::fill(begin + column_at(x[i]), begin + column_at(x[i + 1]), static_cast<std::uint16_t>(tool + 1));
      }
    }
  }
  return number;
}

/// The colours of fine pixels, `fineness` along a side of a pixel: bands over outlines over the mesh over the tets, and
/// tools outside the tets.
class FinePicture {
public:
  FinePicture(const TetRaster& fine, const BandRaster& bands, const std::vector<std::uint16_t>& tools,
              const std::vector<Colour>& tet_colour, const std::vector<std::int32_t>& tet_grain, const Lines& lines)
      : fine_(fine), bands_(bands), tools_(tools), tet_colour_(tet_colour), tet_grain_(tet_grain), lines_(lines) {}

  const Colour& colour_at(int x, int y) const {
    static constexpr Colour mesh_line{90, 90, 90};
    const std::size_t at = index(x, y);
    if (!bands_.painted.empty() && bands_.painted[at]) return bands_.colour[at];
    const std::int32_t tet = fine_.tet[at];
    if (tet < 0) return colour_beside(x, y);
    if (on_outline(x, y)) return lines_.outline;
    if (lines_.mesh && (tet_at(x + 1, y) != tet || tet_at(x, y + 1) != tet)) return mesh_line;
    return tet_colour_[static_cast<std::size_t>(tet)];
  }

private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(fine_.width) + static_cast<std::size_t>(x);
  }
  const Colour& colour_beside(int x, int y) const {
    static constexpr Colour empty{255, 255, 255}, tool{205, 208, 212}, rim{70, 74, 80};
    const int number = tool_at(x, y);
    if (number == 0) return empty;
    for (const auto& [dx, dy] : {std::pair{reach(), 0}, {-reach(), 0}, {0, reach()}, {0, -reach()}})
      if (const int other = tool_at(x + dx, y + dy); other >= 0 && other != number) return rim;
    return tool;
  }
  /// -1 beyond the picture.
  int tool_at(int x, int y) const {
    if (tools_.empty()) return 0;
    return x < 0 || y < 0 || x >= fine_.width || y >= fine_.height ? -1 : tools_[index(x, y)];
  }
  static int reach() { return std::max(1, static_cast<int>(std::lround(line_pixels * fineness))); }
  std::int32_t tet_at(int x, int y) const {
    return x < 0 || y < 0 || x >= fine_.width || y >= fine_.height ? -1 : fine_.tet[index(x, y)];
  }
  std::int32_t grain_at(int x, int y) const {
    const std::int32_t tet = tet_at(x, y);
    return tet < 0 ? -1 : tet_grain_[static_cast<std::size_t>(tet)];
  }
  /// True where another grain, or none, lies within the line's half width.
  bool on_outline(int x, int y) const {
    const std::int32_t grain = grain_at(x, y);
    for (const auto& [dx, dy] :
         {std::pair{reach(), 0}, {-reach(), 0}, {0, reach()}, {0, -reach()}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      if (grain_at(x + dx, y + dy) != grain) return true;
    return false;
  }

  const TetRaster& fine_;
  const BandRaster& bands_;
  const std::vector<std::uint16_t>& tools_;
  const std::vector<Colour>& tet_colour_;
  const std::vector<std::int32_t>& tet_grain_;
  const Lines& lines_;
};

/// The mean of the fine pixels of a pixel.
Colour mean_colour(const FinePicture& fine, int row, int column) {
  std::array<int, 3> sum{};
  for (int j = 0; j < fineness; ++j)
    for (int i = 0; i < fineness; ++i) {
      const Colour& colour = fine.colour_at(column * fineness + i, row * fineness + j);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
    }
  Colour mean{};
  for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>(sum[c] / (fineness * fineness));
  return mean;
}

} // namespace

Raster draw_section(const std::vector<SectionPolygon>& polygons, const std::vector<Colour>& tet_colour,
                    const std::vector<std::int32_t>& tet_grain, const View& view, int pixels, const Lines& lines) {
  const double extent[2] = {view.high[0] - view.low[0], view.high[1] - view.low[1]};
  const double size = std::max(extent[0], extent[1]) / pixels;
  Raster raster;
  raster.width = std::max(1, static_cast<int>(std::lround(extent[0] / size)));
  raster.height = std::max(1, static_cast<int>(std::lround(extent[1] / size)));
  const TetRaster tets = rasterise(polygons, view, fineness * raster.width, fineness * raster.height);
  const BandRaster bands = paint_bands(lines, tets, tet_grain, view);
  const std::vector<std::uint16_t> tools = rasterise_tools(lines.tools, view, tets.width, tets.height);
  const FinePicture fine(tets, bands, tools, tet_colour, tet_grain, lines);
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column) raster.pixel.push_back(mean_colour(fine, row, column));
  return raster;
}

} // namespace mpfem
