#pragma once
// Thickness and diameter of a tablet out of its die, from two states of its grains.
//
// Definition. The nodes of a face lie within a small distance of a punch's plane in the pressed state; those of the
// band lie within it of the die's wall. The tablet's rigid-body motion is removed from the later state. Thickness is
// the distance of the punches in the pressed state, plus the mean upward displacement of the upper face's nodes, minus
// that of the lower face's. Diameter is that of the die plus twice the mean outward displacement of the band's nodes,
// with the band's sideways translation removed. Only displacements of the same nodes count, so that it does not matter
// that a face of grains is uneven, or that nodes lie slightly off a punch or inside it.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "postproc/fits/statistics.hpp"

namespace mpfem {

/// The same nodes in the die and later.
struct TabletStates {
  std::span<const float> pressed, later;    ///< [nodes * 3], mm
  std::span<const std::int32_t> node_grain; ///< [nodes]
  std::array<double, 3> low{}, high{};      ///< mm, the box around the pressed tablet: punches at low[2] and high[2],
                                            ///< die of diameter high[0] - low[0] around its middle
};

/// Which nodes and grains count.
struct TabletShapeRule {
  double face_distance = 0;     ///< mm, largest distance of face and band nodes from punches and die
  double largest_departure = 0; ///< mm: a grain displaced farther relative to the others has left the tablet
};

/// Lengths in mm. Half widths are those of ratio_of_sums over the grains of faces and band: they cover the difference
/// to other packings of this size.
struct TabletShape {
  Ratio thickness, diameter;
  std::size_t upper_grains = 0, lower_grains = 0, band_grains = 0; ///< grains with nodes in faces and band
  std::size_t grains_lost = 0;                                     ///< grains that have left the tablet
};

/// Empty, with the reason in `why`, where there are fewer than three grains in all, at a face or at the die.
std::optional<TabletShape> tablet_shape(const TabletStates& states, const TabletShapeRule& rule, std::string& why);

} // namespace mpfem
