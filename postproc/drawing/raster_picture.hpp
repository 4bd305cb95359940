#pragma once
// A raster with axes, title and colour bar, as a PNG picture.

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "postproc/drawing/raster.hpp"

namespace mpfem {

/// A colour scale next to a picture.
struct ColourBar {
  std::pair<double, double> range;
  std::string label;                 ///< with its unit
  bool below = false, above = false; ///< whether the picture shows values beyond that end

  /// Notes that the picture shows this value. What is beyond an end by less than a thousandth of the scale is not.
  void add(double value);
  /// What is written next to the lower and the upper end: "≤ LOW" and "≥ HIGH" where values lie beyond, else nothing.
  std::array<std::string, 2> end_texts() const;
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
