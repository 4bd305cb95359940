#pragma once
// A section as a picture: fields in colour, grains outlined, with box, axes and colour bar.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "postproc/drawing/raster.hpp"
#include "postproc/drawing/section.hpp"

namespace mpfem {

/// What a picture of a section shows.
struct PictureRequest {
  CutPlane plane;
  std::string field = "von_mises";
  /// Ends of the colour scale. Default: 0 (or the 0.5th percentile where that is lower) and the 99.5th percentile of
  /// what is seen.
  std::optional<std::pair<double, double>> range;
  std::string title; ///< default: the relative density
  int pixels = 900;
  bool mesh_lines = false;
  bool tools = true;        ///< draw the rigid tools that are in place
  std::optional<View> view; ///< default: the box, or drawn_extent where tools are drawn
};

/// Writes the PNG through gnuplot. The field "damage" is drawn along the grains' boundaries, on a scale from 0 to 1
/// where no range is given: a coloured line inside each grain where its nodes have been bonded, a thin grey line
/// elsewhere. Throws InputError where the plane misses the grains or the field is unknown, SimulationError where
/// gnuplot is missing or fails, StorageError where the file cannot be written.
void write_section_picture(const std::string& path, const Snapshot& snapshot, const PictureRequest& request);

/// The section's polygons as CSV: tet, grain, value, area (mm^2), centre u, v (mm, mean of the corners). Throws
/// InputError where the field is unknown.
std::string section_csv(const Snapshot& snapshot, const std::vector<SectionPolygon>& polygons,
                        const std::string& field);

} // namespace mpfem
