#include "postproc/drawing/raster_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/files/gnuplot.hpp"
#include "postproc/files/text_file.hpp"

namespace mpfem {

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
  if (frame.bar) {
    script += "set palette defined (";
    constexpr int steps = 32;
    for (int i = 0; i <= steps; ++i) {
      const Colour c = scale_colour(static_cast<double>(i) / steps);
      script += fmt::format("{}{} '#{:02x}{:02x}{:02x}'", i ? ", " : "", i, c[0], c[1], c[2]);
    }
    script += fmt::format(")\nset cbrange [{}:{}]\nset cblabel {} noenhanced\nset colorbox\n", frame.bar->range.first,
                          frame.bar->range.second, gnuplot_string(frame.bar->label));
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
