#include "postproc/drawing/raster_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/drawing/ticks.hpp"
#include "postproc/files/gnuplot.hpp"
#include "postproc/files/text_file.hpp"

namespace mpfem {

namespace {

/// The colour bar at the right of the raster, with what is written at its ends. Lengths as fractions of the picture.
std::string bar_script(const ColourBar& bar, const View& place, double letter_height) {
  std::string script = "set palette defined (";
  constexpr int steps = 32;
  for (int i = 0; i <= steps; ++i) {
    const Colour c = scale_colour(static_cast<double>(i) / steps);
    script += fmt::format("{}{} '#{:02x}{:02x}{:02x}'", i ? ", " : "", i, c[0], c[1], c[2]);
  }
  const auto [left, low] = place.low;
  const auto [right, high] = place.high;
  script += fmt::format(")\nset cbrange [{}:{}]\nset cblabel {} noenhanced\n", bar.range.first, bar.range.second,
                        gnuplot_string(bar.label));
  script += fmt::format("set colorbox user origin {},{} size {},{}\n", left, low, right - left, high - low);
  const auto texts = bar.end_texts();
  for (const auto& [text, y] : {std::pair{texts[0], low - letter_height}, {texts[1], high + letter_height}})
    if (!text.empty())
      script += fmt::format("set label {} at screen {},{} center noenhanced\n", gnuplot_string(text),
                            0.5 * (left + right), y);
  return script;
}

/// Ticks of an axis that is `pixels` long, so that each has `room` (pixels) for its label.
std::string ticks_script(const std::string& axis, std::pair<double, double> range, int pixels, int room) {
  int most = std::clamp(pixels / room, 1, 8);
  while (round_ticks(range, most).empty()) ++most;
  return fmt::format("set {}tics {:g}\n", axis, tick_distance(range, most));
}

} // namespace

void ColourBar::add(double value) {
  const double tolerance = 1e-3 * (range.second - range.first);
  below = below || value < range.first - tolerance;
  above = above || value > range.second + tolerance;
}

std::array<std::string, 2> ColourBar::end_texts() const {
  return {below ? fmt::format("≤ {:.3g}", range.first) : "", above ? fmt::format("≥ {:.3g}", range.second) : ""};
}

void write_raster_picture(const std::string& path, const Raster& raster, const Frame2d& frame) {
  std::string bytes;
  for (const Colour& pixel : raster.pixel) bytes.append(reinterpret_cast<const char*>(pixel.data()), 3);
  const TemporaryFile data(bytes), picture("");

  const View& view = frame.view;
  const double pixel_width = (view.high[0] - view.low[0]) / raster.width,
               pixel_height = (view.high[1] - view.low[1]) / raster.height;
  // Margins in pixels, so that a pixel of the raster is one of the picture. Margins and text grow with the picture, so
  // that a finer one looks the same in print.
  const double scale = std::max(0.6, frame.pixels / 900.0);
  const auto scaled = [scale](int pixels) { return static_cast<int>(std::lround(scale * pixels)); };
  const int left = scaled(175), right = scaled(frame.bar ? 225 : 40), bottom = scaled(115), top = scaled(70);
  const double width = left + raster.width + right, height = bottom + raster.height + top;
  std::string script = fmt::format("set terminal pngcairo size {},{} font 'Sans,{:.1f}' enhanced\nset output {}\n",
                                   width, height, 19 * scale, gnuplot_string(picture.path()));
  script += fmt::format("set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\nset tics out "
                        "nomirror\nset border lw {:.2f}\n"
                        "set xrange [{}:{}]\nset yrange [{}:{}]\n",
                        gnuplot_string(frame.title), gnuplot_string(frame.x_label), gnuplot_string(frame.y_label),
                        1.5 * scale, view.low[0], view.high[0], view.low[1], view.high[1]);
  script += fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n",
      left / width, (left + raster.width) / width, bottom / height, (bottom + raster.height) / height);
  // A label is up to five letters wide. gnuplot does not see where labels meet.
  script += ticks_script("x", {view.low[0], view.high[0]}, raster.width, scaled(95));
  script += ticks_script("y", {view.low[1], view.high[1]}, raster.height, scaled(45));
  if (frame.bar) {
    script += ticks_script("cb", frame.bar->range, raster.height, scaled(45));
    const double bar_left = left + raster.width + scaled(35), bar_right = bar_left + scaled(40);
    script += bar_script(*frame.bar,
                         {{bar_left / width, bottom / height}, {bar_right / width, (bottom + raster.height) / height}},
                         scaled(20) / height);
  }
  script += "unset key\n";
  script += fmt::format(
      "plot {} binary array=({},{}) format='%uchar' flipy origin=({},{}) dx={} dy={} using 1:2:3 with rgbimage",
      gnuplot_string(data.path()), raster.width, raster.height, view.low[0] + 0.5 * pixel_width,
      view.low[1] + 0.5 * pixel_height, pixel_width, pixel_height);
  // gnuplot draws the colour bar only for a plot that uses the palette: a point outside the view does.
  script += frame.bar ? fmt::format(", '-' using 1:2:3 with points pt 0 lc palette\n{} {} 0\ne\n",
                                    2 * view.high[0] - view.low[0], 2 * view.high[1] - view.low[1])
                      : "\n";
  script += "set output\n";
  run_gnuplot(script);
  const std::string png = picture.content();
  if (!png.starts_with("\x89PNG")) throw SimulationError("gnuplot made no PNG picture");
  write_file(path, png);
}

} // namespace mpfem
