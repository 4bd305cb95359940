#pragma once
// Where the bonds of a disc broke in a diametral compression: its strength holds where the crack began in the centre.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "postproc/bond_table.hpp"

namespace mpfem {

/// The disc before the test.
struct DiscGeometry {
  std::span<const float> node;    ///< [nodes * 3], mm
  int load_axis = 0, across = 1;  ///< 0, 1, 2 for x, y, z; `across` is perpendicular to load and to the disc's axis
  std::array<double, 3> middle{}; ///< mm
  double diameter = 0;            ///< mm
};

/// Shares of the area of bonds that were whole before and are broken after.
struct DiscCrack {
  double area = 0;          ///< mm^2, both sides of every contact
  double near_diameter = 0; ///< no farther than D/8 from the loaded diameter
  double in_centre = 0;     ///< of all: these that are also no farther than 0.6 R from the centre
};

/// Bonds by the places of their nodes before the test. Nothing where none broke.
std::optional<DiscCrack> disc_crack(const std::vector<BondRow>& before, const std::vector<BondRow>& after,
                                    const DiscGeometry& disc);

} // namespace mpfem
