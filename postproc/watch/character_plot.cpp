#include "postproc/watch/character_plot.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace mpfem {

namespace {

struct Point {
  double x, y;
};

struct Extent {
  double low, high;
  /// 0 at the low end, 1 at the high end; 0.5 for an extent without length.
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

std::vector<Point> finite_points(std::span<const double> x, std::span<const double> y) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) points.push_back({x[i], y[i]});
  return points;
}

template <class Coordinate>
Extent extent_of(const std::vector<Point>& points, Coordinate coordinate) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [&](const Point& a, const Point& b) { return coordinate(a) < coordinate(b); });
  return {coordinate(*low), coordinate(*high)};
}

/// The grid of characters, first row on top.
class Canvas {
public:
  Canvas(int columns, int rows) : columns_(columns), line_(static_cast<std::size_t>(rows)) {
    for (std::string& line : line_) line.assign(static_cast<std::size_t>(columns), ' ');
  }
  /// Draws a line between two points; coordinates from 0 to 1, from the lower left corner.
  void join(const Point& from, const Point& to) {
    const double width = columns_ - 1, height = static_cast<double>(line_.size()) - 1;
    const double cells = std::max(std::abs(to.x - from.x) * width, std::abs(to.y - from.y) * height);
    const int steps = std::max(1, static_cast<int>(std::ceil(cells)));
    for (int i = 0; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps;
      const auto column = static_cast<std::size_t>(std::lround((from.x + s * (to.x - from.x)) * width));
      const auto row = static_cast<std::size_t>(std::lround((1 - from.y - s * (to.y - from.y)) * height));
      line_[row][column] = '*';
    }
  }
  const std::vector<std::string>& lines() const { return line_; }

private:
  int columns_;
  std::vector<std::string> line_;
};

} // namespace

std::string draw(const CharacterPlot& plot, std::span<const double> x, std::span<const double> y) {
  const std::vector<Point> points = finite_points(x, y);
  if (points.empty()) return {};
  const Extent along = extent_of(points, [](const Point& p) { return p.x; });
  const Extent up = extent_of(points, [](const Point& p) { return p.y; });
  const auto place = [&](const Point& p) { return Point{along.share(p.x), up.share(p.y)}; };
  Canvas canvas(plot.columns, plot.rows);
  for (std::size_t i = 0; i < points.size(); ++i) canvas.join(place(points[i > 0 ? i - 1 : 0]), place(points[i]));
  const std::string top = fmt::format("{:.4g}", up.high), bottom = fmt::format("{:.4g}", up.low);
  const std::size_t margin = std::max(top.size(), bottom.size());
  std::string text = fmt::format("{:>{}}  {}\n", "", margin, plot.y_label);
  for (std::size_t row = 0; row < canvas.lines().size(); ++row)
    text += fmt::format("{:>{}} |{}\n",
                        row == 0                           ? top
                        : row + 1 == canvas.lines().size() ? bottom
                                                           : "",
                        margin, canvas.lines()[row].substr(0, canvas.lines()[row].find_last_not_of(' ') + 1));
  text += fmt::format("{:>{}} +{:->{}}\n", "", margin, "", plot.columns);
  const std::string left = fmt::format("{:.4g}", along.low), right = fmt::format("{:.4g}", along.high);
  const int middle = std::max(0, plot.columns - static_cast<int>(left.size() + right.size()));
  return text + fmt::format("{:>{}}  {}{:^{}}{}\n", "", margin, left, plot.x_label, middle, right);
}

} // namespace mpfem
