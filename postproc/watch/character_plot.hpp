#pragma once
// A curve drawn with characters, for a terminal.

#include <span>
#include <string>

namespace mpfem {

/// Size and labels of a drawing.
struct CharacterPlot {
  std::string x_label, y_label; ///< with units
  int columns = 64, rows = 14;  ///< size of the drawing in characters, without numbers and labels; at least 2
};

/// The curve through the points, joined in their order, with the ends of both axes as numbers; each line ends with a
/// line break. Axes span the points. Points that are not finite are left out; empty where none is left.
std::string draw(const CharacterPlot& plot, std::span<const double> x, std::span<const double> y);

} // namespace mpfem
