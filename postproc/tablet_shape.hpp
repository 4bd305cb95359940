#pragma once
// Thickness and diameter of a tablet out of its die, from two states of its grains.
//
// Definition. The faces are the nodes that lie within a small distance of the punches' planes in the pressed state,
// the band those within it of the die's wall. Of the later state the tablet's motion as a rigid body is taken away.
// Thickness is the distance of the punches in the pressed state and what the mean of the upper face's nodes has since
// moved up more than that of the lower face's. Diameter is the die's and twice what the band's nodes have moved
// outwards in the mean, the band's motion to one side taken away. So what counts is how far the same nodes have moved:
// that a face of grains is not flat, and that nodes stand a little off a punch or within it, falls out.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "postproc/statistics.hpp"

namespace mpfem {

/// The same nodes in the die and later.
struct TabletStates {
  std::span<const float> pressed, later;    ///< [nodes * 3], mm
  std::span<const std::int32_t> node_grain; ///< [nodes]
  std::array<double, 3> low{}, high{};      ///< mm, of the box about the pressed tablet: punches at low[2] and high[2],
                                            ///< the die's diameter high[0] - low[0] about its middle
};

struct TabletShapeRule {
  double face_distance = 0;     ///< mm, of nodes of faces and band from punches and die
  double largest_departure = 0; ///< mm: a grain that has moved farther against the others has left the tablet
};

/// Lengths in mm. Half widths are those of ratio_of_sums over the grains of faces and band: another packing as large.
struct TabletShape {
  Ratio thickness, diameter;
  std::size_t upper_grains = 0, lower_grains = 0, band_grains = 0; ///< that faces and band are read from
  std::size_t grains_lost = 0;                                     ///< that have left the tablet
};

/// Says in `why` what is missing where there is no such shape: three grains or more at each face and at the die.
std::optional<TabletShape> tablet_shape(const TabletStates& states, const TabletShapeRule& rule, std::string& why);

} // namespace mpfem
