#pragma once
// Where the bonds of a disc broke in a diametral compression: its strength is valid if the crack began in the centre.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "postproc/run_data/bond_table.hpp"

namespace mpfem {

/// The disc before the test.
struct DiscGeometry {
  std::span<const float> node;    ///< [nodes * 3], mm
  int load_axis = 0, across = 1;  ///< 0, 1, 2 for x, y, z; `across` is normal to the load and to the disc's axis
  std::array<double, 3> middle{}; ///< mm
  double diameter = 0;            ///< mm
};

/// Bonds that are broken after the test and were not broken before, by area.
struct DiscCrack {
  double area = 0;          ///< mm^2, both sides of every contact
  double near_diameter = 0; ///< share of the area within D/8 of the loaded diameter
  double in_centre = 0;     ///< share of the area that also lies within 0.6 R of the centre
  /// What `in_centre` would be if the bonds within D/8 of the loaded diameter had broken evenly along it. A crack that
  /// begins in the centre has more there, one that begins under the plates has less.
  double in_centre_if_even = 0;
  /// Of the bonds that were whole in the centre (both limits above) before the test, the share of the area that is
  /// broken. It is large in a disc that splits, and 0 where a grain breaks off the rim.
  double of_centre = 0;
};

/// A bond's place is that of its node before the test. Empty where none broke.
std::optional<DiscCrack> disc_crack(const std::vector<BondRow>& before, const std::vector<BondRow>& after,
                                    const DiscGeometry& disc);

} // namespace mpfem
