#pragma once
// A section as a picture: fields in colour, grains outlined, with box, axes and colour bar.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "postproc/colour_scale.hpp"
#include "postproc/section.hpp"

namespace mpfem {

/// Pixels row by row from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<Colour> pixel;
};

/// What the picture shows of the plane: [low, high] in its two coordinates, mm.
struct View {
  std::array<double, 2> low{}, high{};
};

/// Fills the polygons with their tets' colours (one a tet) and draws a dark line between different grains and around
/// them, with `mesh_lines` also a thin one between tets. `pixels` along the longer side; smoothed by drawing three times
/// as fine.
Raster draw_section(const std::vector<SectionPolygon>& polygons, const std::vector<Colour>& tet_colour,
                    const std::vector<std::int32_t>& tet_grain, const View& view, int pixels, bool mesh_lines = false);

struct PictureRequest {
  CutPlane plane;
  std::string field = "von_mises";
  std::optional<std::pair<double, double>> range; ///< of the colour scale; default: 0 … the 99.5th percentile of the section
  std::string title;                              ///< default: field and relative density
  int pixels = 900;
  bool mesh_lines = false;
  std::optional<View> view; ///< default: the box
};

/// Writes the PNG through gnuplot. Throws InputError where the plane misses the grains or the field is unknown,
/// SimulationError where gnuplot is missing or fails, StorageError.
void write_section_picture(const std::string& path, const Snapshot& snapshot, const PictureRequest& request);

/// The section's polygons as CSV: tet, grain, value, area, centroid.
std::string section_csv(const Snapshot& snapshot, const std::vector<SectionPolygon>& polygons, const std::string& field);

} // namespace mpfem
