#pragma once
// Where a plot's key lies, so that it does not cover what the plot shows.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mpfem {

/// Points of a plot in the values of its axes, and whether a line joins them. An infinite value is the end of an axis.
struct DrawnLine {
  std::vector<std::array<double, 2>> points;
  bool joined = false;
};

/// An axis as the plot shows it. A limit that is not given follows from the data.
struct ShownAxis {
  std::optional<double> low, high;
  bool logarithmic = false;
};

/// Width and height as fractions of the area inside the axes.
struct KeySize {
  double width = 0, height = 0;
};

/// The size of a key with these titles, one below the other. Empty titles have no line in the key. `title`: the key's
/// own, or empty.
KeySize key_size(const std::vector<std::string>& titles, const std::string& title);

/// A place for a key of this size in gnuplot's words: the first corner that holds no data, or one outside the axes
/// where there is none. The limits that gnuplot chooses for itself are estimated: a corner is free only at some
/// distance to the data.
std::string key_place(const std::vector<DrawnLine>& lines, const ShownAxis& x, const ShownAxis& y, const KeySize& size);

} // namespace mpfem
