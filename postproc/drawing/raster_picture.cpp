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

namespace {

/// Where the raster lies in the picture, in pixels: margins are whole, so that a pixel of the raster is one of the
/// picture. Margins and text grow with the picture, so that a finer one looks the same in print.
struct Layout {
  Layout(const Raster& raster, const Frame2d& frame)
      : scale(std::max(0.6, frame.pixels / 900.0)), left(scaled(175)), bottom(scaled(115)),
        width(left + raster.width + scaled(frame.bar ? 225 : 40)), height(bottom + raster.height + scaled(70)),
        raster_right((left + raster.width) / width), raster_top((bottom + raster.height) / height) {}
  int scaled(int pixels) const { return static_cast<int>(std::lround(scale * pixels)); }

  double scale;
  int left, bottom;
  double width, height;
  double raster_right, raster_top; ///< as fractions of the picture
};

std::string frame_script(const Layout& layout, const Frame2d& frame, const std::string& picture) {
  const View& view = frame.view;
  std::string script = fmt::format("set terminal pngcairo size {},{} font 'Sans,{:.1f}' enhanced\nset output {}\n",
                                   layout.width, layout.height, 19 * layout.scale, gnuplot_string(picture));
  script += fmt::format("set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\nset tics out "
                        "nomirror\nset border lw {:.2f}\n"
                        "set xrange [{}:{}]\nset yrange [{}:{}]\n",
                        gnuplot_string(frame.title), gnuplot_string(frame.x_label), gnuplot_string(frame.y_label),
                        1.5 * layout.scale, view.low[0], view.high[0], view.low[1], view.high[1]);
  return script +
         fmt::format(
             "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n",
             layout.left / layout.width, layout.raster_right, layout.bottom / layout.height, layout.raster_top);
}

/// Ticks of the axes, and the colour bar with its own.
std::string scales_script(const Layout& layout, const Raster& raster, const Frame2d& frame) {
  const View& view = frame.view;
  // A label is up to five letters wide. gnuplot does not see where labels meet.
  std::string script = ticks_script("x", {view.low[0], view.high[0]}, raster.width, layout.scaled(95)) +
                       ticks_script("y", {view.low[1], view.high[1]}, raster.height, layout.scaled(45));
  if (!frame.bar) return script;
  script += ticks_script("cb", frame.bar->range, raster.height, layout.scaled(45));
  const double bar_left = layout.left + raster.width + layout.scaled(35), bar_right = bar_left + layout.scaled(40);
  return script + bar_script(*frame.bar,
                             {{bar_left / layout.width, layout.bottom / layout.height},
                              {bar_right / layout.width, layout.raster_top}},
                             layout.scaled(20) / layout.height);
}

/// `data`: file of the raster's pixels.
std::string plot_command(const Raster& raster, const Frame2d& frame, const std::string& data) {
  const View& view = frame.view;
  const double pixel_width = (view.high[0] - view.low[0]) / raster.width,
               pixel_height = (view.high[1] - view.low[1]) / raster.height;
  const std::string image = fmt::format(
      "plot {} binary array=({},{}) format='%uchar' flipy origin=({},{}) dx={} dy={} using 1:2:3 with rgbimage",
      gnuplot_string(data), raster.width, raster.height, view.low[0] + 0.5 * pixel_width,
      view.low[1] + 0.5 * pixel_height, pixel_width, pixel_height);
  // gnuplot draws the colour bar only for a plot that uses the palette: a point outside the view does.
  if (!frame.bar) return image + "\n";
  return image + fmt::format(", '-' using 1:2:3 with points pt 0 lc palette\n{} {} 0\ne\n",
                             2 * view.high[0] - view.low[0], 2 * view.high[1] - view.low[1]);
}

} // namespace

void write_raster_picture(const std::string& path, const Raster& raster, const Frame2d& frame) {
  std::string bytes;
  for (const Colour& pixel : raster.pixel) bytes.append(reinterpret_cast<const char*>(pixel.data()), 3);
  const TemporaryFile data(bytes), picture("");
  const Layout layout(raster, frame);
  run_gnuplot(frame_script(layout, frame, picture.path()) + scales_script(layout, raster, frame) + "unset key\n" +
              plot_command(raster, frame, data.path()) + "set output\n");
  const std::string png = picture.content();
  if (!png.starts_with("\x89PNG")) throw SimulationError("gnuplot made no PNG picture");
  write_file(path, png);
}

} // namespace mpfem
