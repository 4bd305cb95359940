#pragma once
// Sections painted pixel by pixel.

#include <array>
#include <cstdint>
#include <vector>

#include "postproc/colour_scale.hpp"
#include "postproc/section.hpp"

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

/// Fills the polygons with their tets' colours (one a tet) and draws a dark line between different grains and around
/// them, with `mesh_lines` also a thin one between tets. `pixels` along the longer side; smoothed by drawing three times
/// as fine.
Raster draw_section(const std::vector<SectionPolygon>& polygons, const std::vector<Colour>& tet_colour,
                    const std::vector<std::int32_t>& tet_grain, const View& view, int pixels, bool mesh_lines = false);

} // namespace mpfem
