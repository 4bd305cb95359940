#pragma once
// A raster with axes, title and colour bar, as a PNG picture.

#include <optional>
#include <string>
#include <utility>

#include "postproc/drawing/raster.hpp"

namespace mpfem {

/// A colour scale next to a picture.
struct ColourBar {
  std::pair<double, double> range;
  std::string label; ///< with its unit
};

/// Axes, title and colour bar of a raster.
struct Frame2d {
  View view;                           ///< what the raster shows, mm
  std::string title, x_label, y_label; ///< labels with units
  std::optional<ColourBar> bar;        ///< of scale_colour
  int pixels = 900;                    ///< along the raster's longer side; margins and text grow with it
};

/// Writes the PNG through gnuplot; one pixel of the raster is one of the picture. Throws SimulationError where gnuplot
/// is missing or fails, StorageError where the file cannot be written.
void write_raster_picture(const std::string& path, const Raster& raster, const Frame2d& frame);

} // namespace mpfem
