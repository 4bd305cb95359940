#pragma once
// Sections drawn pixel by pixel.

#include <array>
#include <cstdint>
#include <vector>

#include "postproc/drawing/colour_scale.hpp"
#include "postproc/drawing/section.hpp"
#include "postproc/drawing/tool_outline.hpp"

namespace mpfem {

/// Pixels row by row from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<Colour> pixel;
};

/// The part of the plane that a picture shows: [low, high] in its two coordinates, mm.
struct View {
  std::array<double, 2> low{}, high{};
};

/// A line along a grain's boundary, drawn inside the grain. Values are fractions for scale_colour, linear from end to
/// end.
struct Band {
  std::array<double, 2> from{}, to{}; ///< mm
  double value_from = 0, value_to = 0;
  std::int32_t grain = 0;
};

/// What is drawn over the polygons, and next to them.
struct Lines {
  bool mesh = false;          ///< thin lines between tets
  Colour outline{25, 25, 25}; ///< between different grains and around them
  std::vector<Band> bands;    ///< over the outlines
  double band_pixels = 5;     ///< width of a band
  /// Outlines of rigid tools, filled with grey where there is no grain.
  std::vector<std::vector<OutlinePiece>> tools;
};

/// Fills the polygons with their tets' colours ([tets]) and draws lines over them. `pixels`: number along the longer
/// side. Each pixel is the mean of 3 x 3 finer ones.
Raster draw_section(const std::vector<SectionPolygon>& polygons, const std::vector<Colour>& tet_colour,
                    const std::vector<std::int32_t>& tet_grain, const View& view, int pixels, const Lines& lines = {});

} // namespace mpfem
