#pragma once
// What a test did to the bonds that it found, apart from those that formed while it ran.

#include <string>
#include <vector>

#include "postproc/bond_table.hpp"
#include "postproc/measurement.hpp"

namespace mpfem {

/// The bonds of a later snapshot, by what they were at an earlier one.
struct BondsSince {
  std::vector<BondRow> found;          ///< unbroken then, as they are now
  std::vector<BondRow> found_before;   ///< [found], as they were then
  std::vector<BondRow> formed;         ///< not there then, or broken and formed anew since
  std::vector<BondRow> broken_already; ///< broken then and now
};

/// Bonds are told by node and grain. One that was broken and is not any more has formed anew. What was there then must
/// be there now.
BondsSince bonds_since(const std::vector<BondRow>& before, const std::vector<BondRow>& now);

/// Of the bonds that were unbroken at snapshot `snapshot_before` of `before`: how much their area-weighted mean damage
/// has grown by snapshot `snapshot` of `file`. In the details both means, shares broken, energy by damage over the
/// energy to break them, and the same of the bonds formed since. Uncertainty: as of `damage`, by pairs of grains.
/// `before` may be the run that this one branched from, or this run. Throws InputError where the files' packings
/// differ.
Measurement measure_damage_of_test(const schema::FileReader& file, int snapshot, const schema::FileReader& before,
                                   int snapshot_before);

} // namespace mpfem
