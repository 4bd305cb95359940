// A plot as png and as svg, the latter in a browser without a window: both look alike. Built where chromium is.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "browser.hpp"
#include "postproc/figure/figure_plot.hpp"
#include "postproc/files/gnuplot.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr unsigned int png_width = 1200, png_height = 900;

/// A figure's only plot: points of every shape, hollow and filled, a dashed line, and their key.
Figure figure_in(const Folder& folder) {
  std::string points = "x,y\n", series;
  for (int i = 1; i <= 9; ++i) points += fmt::format("{0},{0}\n", i);
  for (int shape = 1; shape <= 15; ++shape)
    series += fmt::format(
        "  {{ table = \"t\", x = \"x\", y = \"y\", y_scale = {}, point = {}, colour = 1, title = \"points {}\" }},\n",
        0.1 * shape, shape, shape);
  write_text(folder / "out/t.csv", points);
  write_text(folder / "study.toml", fmt::format(R"(title = "x"
[[tables]]
name = "t"
file = "t.csv"
columns = ["x", "y"]
[[plots]]
name = "p"
title = "Points of all shapes"
x = {{ label = "number", low = 0, high = 12 }}
y = {{ label = "value / MPa" }}
key = "right top"
series = [
{}  {{ table = "t", x = "x", y = "y", style = "lines", dash = "dashed", colour = 2, title = "dashed" }},
]
)",
                                                series));
  return read_figure(folder / "study.toml", folder / ".");
}

std::string plot_as(const Folder& folder, const std::string& format) {
  const Figure figure = figure_in(folder);
  FigureData data(figure, folder / "out");
  const std::string path = folder / ("p." + format);
  run_gnuplot(plot_script(figure.plots[0], data, folder / "out", format, path, 0));
  if (format == "svg") write_text(path, with_points_as_in_png(read_text(path)));
  return path;
}

/// Share of the picture in a colour of Okabe and Ito.
double share_of(const Image& image, const std::array<int, 3>& colour) {
  return image.share([&](const std::array<int, 3>& c) {
    return std::abs(c[0] - colour[0]) + std::abs(c[1] - colour[1]) + std::abs(c[2] - colour[2]) < 100;
  });
}

/// The first column and the first row, from the left and from the top, that are not white.
std::array<unsigned int, 2> corner_of(const Image& image) {
  std::array<unsigned int, 2> corner = {image.width, image.height};
  for (unsigned int y = 0; y < image.height; ++y)
    for (unsigned int x = 0; x < image.width; ++x)
      if (!is_white(image.at(x, y))) corner = {std::min(corner[0], x), std::min(corner[1], y)};
  return corner;
}

} // namespace

TEST_CASE("a plot as svg has the points, the dashes and the margins of the plot as png") {
  const Folder folder;
  const Image png = read_png(plot_as(folder, "png"));
  const Shown svg = show(folder, plot_as(folder, "svg"), png_width, png_height);
  REQUIRE(png.width == png_width);
  REQUIRE(svg.image.width == png_width);
  // Edges are smoothed differently, which matters most for thin dashes. gnuplot's own points have five times this area,
  // its own dashes half this length.
  const std::array<int, 3> points = {0, 114, 178}, dashes = {213, 94, 0};
  CHECK(share_of(svg.image, points) == Approx(share_of(png, points)).epsilon(0.12));
  CHECK(share_of(svg.image, dashes) == Approx(share_of(png, dashes)).epsilon(0.25));
  const auto here = corner_of(svg.image), there = corner_of(png);
  for (std::size_t i = 0; i < 2; ++i) CHECK(std::abs(static_cast<int>(here[i]) - static_cast<int>(there[i])) < 15);
}
