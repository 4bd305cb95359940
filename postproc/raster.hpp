#pragma once
// Sections painted pixel by pixel.

#include <array>
#include <cstdint>
#include <vector>

#include "postproc/colour_scale.hpp"
#include "postproc/section.hpp"
#include "postproc/tool_outline.hpp"

namespace mpfem {

/// Pixels row by row from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<Colour> pixel;
};

/// What a picture shows of the plane: [low, high] in its two coordinates, mm.
struct View {
  std::array<double, 2> low{}, high{};
};

/// A line along a grain's boundary, painted inside the grain. Values are fractions of scale_colour, linear in between.
struct Band {
  std::array<double, 2> from{}, to{}; ///< mm
  double value_from = 0, value_to = 0;
  std::int32_t grain = 0;
};

/// What is drawn over the polygons, and next to them.
struct Lines {
  bool mesh = false;          ///< thin ones between tets
  Colour outline{25, 25, 25}; ///< between different grains and around them
  std::vector<Band> bands;    ///< over the outlines
  double band_pixels = 5;     ///< width of a band
  /// Of rigid tools, filled with grey where no grain is.
  std::vector<std::vector<OutlinePiece>> tools;
};

/// Fills the polygons with their tets' colours (one a tet) and draws lines over them. `pixels` along the longer side;
/// smoothed by drawing three times as fine.
Raster draw_section(const std::vector<SectionPolygon>& polygons, const std::vector<Colour>& tet_colour,
                    const std::vector<std::int32_t>& tet_grain, const View& view, int pixels, const Lines& lines = {});

} // namespace mpfem
