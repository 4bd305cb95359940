#pragma once
// How large a body from an STL file is beside the grains. STL files state no unit, so a wrong scale is the usual reason
// why the two do not fit; messages about their fit say so.

#include <array>
#include <string>

#include "common/bounds.hpp"

namespace mpfem {

/// A body as read, and the key that scaled it.
struct StlSize {
  std::string file;
  std::string key;                ///< where the user gives the scale
  double scale = 1;               ///< mm in the file's unit of length
  std::array<double, 3> length{}; ///< mm, of its bounding box
};

/// mm, of the edges of a box.
std::array<double, 3> lengths_of(const Bounds& bounds);

/// "1 x 1 x 1.2 mm", of edges in mm.
std::string edges_text(const std::array<double, 3>& length);

/// "FILE spans 1 x 1 x 1 mm with KEY = 0.001, WHAT 5 x 5 x 5 mm (STL files state no unit: KEY is the mm in one)".
/// `what` has the edges `length` (mm) that the body should fit.
std::string size_beside(const StlSize& body, const std::string& what, const std::array<double, 3>& length);

/// The edges of the body over those of a box (mm), in the geometric mean.
double mean_ratio(const StlSize& body, const std::array<double, 3>& length);
inline constexpr double unlikely_ratio = 20; ///< below the 25.4 of inches, the smallest usual error of a unit

} // namespace mpfem
