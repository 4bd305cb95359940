#include "postproc/figure/key_place.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

namespace {

// Of the pictures of 1200 x 900 points that plots are: a character, a line of the key, its sample with gaps, and the
// area inside the axes.
constexpr double character = 14, key_line = 38, sample = 75, inside_width = 1010, inside_height = 770;
/// Keys wider than this fraction of the picture lie below the axes rather than beside them.
constexpr double widest_beside = 0.3;
constexpr double distance = 0.02; ///< of a key to the data, as a fraction of the area inside the axes

/// Characters that gnuplot's markup shows: braces, _ and ^ only set the others.
std::size_t shown_characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    const bool continues_character = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; // of UTF-8
    return !continues_character && c != '{' && c != '}' && c != '_' && c != '^';
  }));
}

/// The distance between the ticks that gnuplot chooses.
double gnuplot_tick_distance(double range) {
  const double power = std::pow(10, std::floor(std::log10(range))), first = range / power;
  return power * (first < 2 ? 0.2 : first < 5 ? 0.5 : 1);
}

/// An axis from 0 to 1.
class Scale {
public:
  Scale(const ShownAxis& axis, double smallest, double largest) : logarithmic_(axis.logarithmic) {
    low_ = of(axis.low.value_or(smallest));
    high_ = of(axis.high.value_or(largest));
    if (!(high_ > low_)) high_ = low_ + 1;
    const double tick = logarithmic_ ? 1 : gnuplot_tick_distance(high_ - low_);
    if (!axis.low) low_ = tick * std::floor(low_ / tick);
    if (!axis.high) high_ = tick * std::ceil(high_ / tick);
  }
  /// Infinite values, the ends of reference lines, lie at the ends of the axis.
  double operator()(double value) const {
    return std::isinf(value) ? (value > 0 ? 1 : 0) : (of(value) - low_) / (high_ - low_);
  }

private:
  double of(double value) const { return logarithmic_ ? std::log10(value) : value; }
  bool logarithmic_;
  double low_, high_;
};

Scale scale_of(const std::vector<DrawnLine>& lines, const ShownAxis& axis, std::size_t direction) {
  double smallest = INFINITY, largest = -INFINITY;
  for (const DrawnLine& line : lines)
    for (const auto& point : line.points) {
      if (!std::isfinite(point[direction]) || (axis.logarithmic && point[direction] <= 0)) continue;
      smallest = std::min(smallest, point[direction]);
      largest = std::max(largest, point[direction]);
    }
  if (smallest > largest) smallest = largest = axis.low.value_or(1);
  return {axis, smallest, largest};
}

using Fractions = std::vector<std::array<double, 2>>;

/// Points of the lines, close to each other where a line joins them, as fractions of the axes.
Fractions places_of(const std::vector<DrawnLine>& lines, const Scale& x, const Scale& y) {
  constexpr int pieces = 50;
  Fractions places;
  for (const DrawnLine& line : lines)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const std::array<double, 2> here = {x(line.points[i][0]), y(line.points[i][1])};
      places.push_back(here);
      if (!line.joined || i == 0) continue;
      const std::array<double, 2> before = {x(line.points[i - 1][0]), y(line.points[i - 1][1])};
      for (int k = 1; k < pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        places.push_back({before[0] + t * (here[0] - before[0]), before[1] + t * (here[1] - before[1])});
      }
    }
  return places;
}

} // namespace

KeySize key_size(const std::vector<std::string>& titles, const std::string& title) {
  std::size_t longest = 0, lines = 0;
  for (const std::string& text : titles) {
    longest = std::max(longest, shown_characters(text));
    lines += text.empty() ? 0 : 1;
  }
  const double width = std::max(sample + character * static_cast<double>(longest),
                                character * static_cast<double>(shown_characters(title)));
  return {width / inside_width, key_line * static_cast<double>(lines + (title.empty() ? 0 : 1)) / inside_height};
}

std::string key_place(const std::vector<DrawnLine>& lines, const ShownAxis& x, const ShownAxis& y,
                      const KeySize& size) {
  const Fractions places = places_of(lines, scale_of(lines, x, 0), scale_of(lines, y, 1));
  const double width = size.width + distance, height = size.height + distance;
  for (const char* corner : {"left top", "right top", "right bottom", "left bottom"}) {
    const std::string words = corner;
    const bool left = words.starts_with("left"), top = words.ends_with("top");
    const bool covers = std::any_of(places.begin(), places.end(), [&](const std::array<double, 2>& place) {
      if (std::min(place[0], place[1]) < -distance || std::max(place[0], place[1]) > 1 + distance) return false;
      return (left ? place[0] < width : place[0] > 1 - width) && (top ? place[1] > 1 - height : place[1] < height);
    });
    if (!covers && width < 1 && height < 1) return words;
  }
  return size.width < widest_beside ? "outside right center vertical" : "outside bottom center vertical maxcols 2";
}

} // namespace mpfem
