#include "postproc/drawing/density_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/drawing/raster_picture.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/tet_geometry.hpp"

namespace mpfem {

namespace {

using Point = Eigen::Vector3d;
using Corners = std::array<Point, 4>;

constexpr std::size_t sectors = 8; // around the axis: their scatter gives the uncertainty of a ring's mean

/// Halves all edges of a tet `depth` times and calls visit(centre) for each of the 8^depth parts, all of the same
/// volume.
template <class Visitor>
void for_each_part(const Corners& x, int depth, Visitor&& visit) {
  if (depth == 0) return visit(Point(0.25 * (x[0] + x[1] + x[2] + x[3])));
  const auto middle = [&](std::size_t a, std::size_t b) { return Point(0.5 * (x[a] + x[b])); };
  const Point m01 = middle(0, 1), m02 = middle(0, 2), m03 = middle(0, 3), m12 = middle(1, 2), m13 = middle(1, 3),
              m23 = middle(2, 3);
  for (const Corners& part : {Corners{x[0], m01, m02, m03}, Corners{x[1], m01, m12, m13}, Corners{x[2], m02, m12, m23},
                              Corners{x[3], m03, m13, m23}, Corners{m01, m02, m03, m13}, Corners{m01, m02, m12, m13},
                              Corners{m02, m03, m13, m23}, Corners{m02, m12, m13, m23}})
    for_each_part(part, depth - 1, visit);
}

/// The cells of a container, each cut into sectors.
class Grid {
public:
  Grid(const Snapshot& snapshot, const DensityMapRule& rule)
      : rings_(static_cast<std::size_t>(rule.rings)), layers_(static_cast<std::size_t>(rule.layers)),
        low_(snapshot.box_low), volume_(rings_ * layers_ * sectors) {
    for (std::size_t axis = 0; axis < 3; ++axis) length_[axis] = snapshot.box_high[axis] - low_[axis];
  }

  double radius() const { return 0.5 * length_[0]; }
  double height() const { return length_[2]; }

  void add(const Point& x, double volume) {
    const double across = x[0] - low_[0] - radius(), along = x[1] - low_[1] - radius();
    const double angle = std::atan2(along, across) / (2 * std::numbers::pi) + 0.5;
    const std::size_t ring = part(std::hypot(across, along) / radius(), rings_),
                      layer = part((x[2] - low_[2]) / height(), layers_), sector = part(angle, sectors);
    volume_[(layer * rings_ + ring) * sectors + sector] += volume;
  }

  DensityCell cell(std::size_t layer, std::size_t ring) const {
    const auto edge = [](double whole, std::size_t i, std::size_t n) {
      return whole * static_cast<double>(i) / static_cast<double>(n);
    };
    DensityCell cell{edge(radius(), ring, rings_),
                     edge(radius(), ring + 1, rings_),
                     edge(height(), layer, layers_),
                     edge(height(), layer + 1, layers_),
                     0,
                     0};
    const double of_sector = std::numbers::pi * (cell.outer * cell.outer - cell.inner * cell.inner) *
                             (cell.high - cell.low) / static_cast<double>(sectors);
    const double* volume = &volume_[(layer * rings_ + ring) * sectors];
    double sum = 0, squares = 0;
    for (std::size_t s = 0; s < sectors; ++s) sum += volume[s] / of_sector;
    cell.density = sum / static_cast<double>(sectors);
    for (std::size_t s = 0; s < sectors; ++s) squares += std::pow(volume[s] / of_sector - cell.density, 2);
    cell.uncertainty = student_t_95(sectors - 1) * std::sqrt(squares / static_cast<double>(sectors * (sectors - 1)));
    return cell;
  }

private:
  static std::size_t part(double fraction, std::size_t parts) {
    const auto wanted = static_cast<std::ptrdiff_t>(std::floor(fraction * static_cast<double>(parts)));
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(wanted, 0, static_cast<std::ptrdiff_t>(parts) - 1));
  }

  std::size_t rings_, layers_;
  std::array<double, 3> low_, length_{};
  std::vector<double> volume_; ///< mm^3, [layers * rings * sectors]
};

Corners corners_of(const Snapshot& snapshot, std::size_t tet) {
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto node = static_cast<std::size_t>(snapshot.tet[4 * tet + i]);
    corners[i] = {snapshot.node[3 * node], snapshot.node[3 * node + 1], snapshot.node[3 * node + 2]};
  }
  return corners;
}

} // namespace

DensityMap density_map(const Snapshot& snapshot, const DensityMapRule& rule) {
  const auto length = [&](std::size_t axis) { return snapshot.box_high[axis] - snapshot.box_low[axis]; };
  if (std::abs(length(0) - length(1)) > 1e-6 * length(0))
    throw InputError(
        fmt::format("snapshot {}: found a box of {:g} x {:g} mm across z, allowed: that of a round die, as "
                    "wide as deep",
                    snapshot.name, length(0), length(1)));
  constexpr int depth = 2; // edges of the parts are a quarter of the tet's
  const double share = std::pow(0.125, depth);
  Grid grid(snapshot, rule);
  DensityMap map{snapshot.name, grid.radius(), grid.height(), 0, rule, {}};
  for (std::size_t tet = 0; tet < snapshot.tets(); ++tet) {
    const double volume = tet_geometry(snapshot, tet).volume;
    map.density += volume;
    for_each_part(corners_of(snapshot, tet), depth, [&](const Point& x) { grid.add(x, share * volume); });
  }
  map.density /= std::numbers::pi * map.radius * map.radius * map.height;
  for (std::size_t layer = 0; layer < static_cast<std::size_t>(rule.layers); ++layer)
    for (std::size_t ring = 0; ring < static_cast<std::size_t>(rule.rings); ++ring)
      map.cells.push_back(grid.cell(layer, ring));
  return map;
}

std::string density_map_csv(const DensityMap& map) {
  std::string text = "inner_radius [mm],outer_radius [mm],low [mm],high [mm],density [1],uncertainty [1]\n";
  for (const DensityCell& cell : map.cells)
    text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{:.3g}\n", cell.inner, cell.outer, cell.low, cell.high,
                        cell.density, cell.uncertainty);
  return text;
}

void write_density_picture(const std::string& path, const DensityMap& map, const std::string& title, int pixels) {
  const auto [least, most] = std::minmax_element(map.cells.begin(), map.cells.end(),
                                                 [](const auto& a, const auto& b) { return a.density < b.density; });
  const double low = least->density, high = std::max(most->density, low + 1e-6);
  const double scale = pixels / std::max(map.radius, map.height);
  Raster raster;
  raster.width = std::max(1, static_cast<int>(std::lround(scale * map.radius)));
  raster.height = std::max(1, static_cast<int>(std::lround(scale * map.height)));
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column) {
      const int layer = (raster.height - 1 - row) * map.rule.layers / raster.height,
                ring = column * map.rule.rings / raster.width;
      const DensityCell& cell = map.cells[static_cast<std::size_t>(layer * map.rule.rings + ring)];
      raster.pixel.push_back(scale_colour((cell.density - low) / (high - low)));
    }
  write_raster_picture(path, raster,
                       {.view = {{0, 0}, {map.radius, map.height}},
                        .title = title.empty() ? fmt::format("solid fraction {:.3f}", map.density) : title,
                        .x_label = "distance from the axis (mm)",
                        .y_label = "height (mm)",
                        .bar = ColourBar{{low, high}, "solid fraction"},
                        .pixels = pixels});
}

} // namespace mpfem
