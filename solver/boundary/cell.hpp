#pragma once
// The cell: the block of space, or the cylinder along z, that the packing fills. Stages move it, and ask it for lengths
// and volume; what stands at its faces (box.hpp: rigid planes) follows.

#include <algorithm>
#include <array>
#include <cstddef>

namespace mpfem {

/// A box along the axes, or the cylinder along z inside it.
struct Cell {
  std::array<double, 3> low{};  ///< mm
  std::array<double, 3> high{}; ///< mm
  double section_share = 1;     ///< share of the block's cross-section along z that the cell fills: pi/4 for a cylinder

  double length(std::size_t axis) const { return high[axis] - low[axis]; }            ///< mm
  std::array<double, 3> lengths() const { return {length(0), length(1), length(2)}; } ///< mm
  double longest() const { return std::max({length(0), length(1), length(2)}); }      ///< mm
  double volume() const { return length(0) * length(1) * length(2) * section_share; } ///< mm^3
  double centre(std::size_t axis) const { return 0.5 * (low[axis] + high[axis]); }    ///< mm
  /// mm^2, over which the forces of the faces across an axis are spread: for a cylinder, its cross-section along z and,
  /// laterally, the middle section through the axis.
  double area(std::size_t axis) const {
    const double block = length((axis + 1) % 3) * length((axis + 2) % 3);
    return axis == 2 ? section_share * block : block;
  }

  /// Moves the two faces across an axis by `distance` (mm) each: inwards, outwards where it is negative.
  void move_inwards(std::size_t axis, double distance) { low[axis] += distance, high[axis] -= distance; }
  /// Multiplies the length along an axis by `scale`; the centre stays.
  void stretch(std::size_t axis, double scale) {
    const double middle = centre(axis), half = 0.5 * scale * length(axis);
    low[axis] = middle - half;
    high[axis] = middle + half;
  }
};

} // namespace mpfem
