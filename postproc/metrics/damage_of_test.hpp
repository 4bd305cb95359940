#pragma once
// What a test did to the bonds that existed before it, apart from those that formed during it.

#include <string>
#include <vector>

#include "postproc/run_data/bond_table.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// The bonds of a later snapshot, grouped by their state at an earlier one.
struct BondsSince {
  std::vector<BondRow> found;          ///< intact then; their state now
  std::vector<BondRow> found_before;   ///< [found], their state then
  std::vector<BondRow> formed;         ///< formed since, or broken then and formed again since
  std::vector<BondRow> broken_already; ///< broken then and now
};

/// Bonds are identified by node and grain. One that was broken and no longer is has formed again. Every bond of
/// `before` must also be in `now`.
BondsSince bonds_since(const std::vector<BondRow>& before, const std::vector<BondRow>& now);

/// The bonds of snapshot `snapshot` of `file`, grouped by their state at snapshot `snapshot_before` of `before`, which
/// may be the run that this one branched from, or this run. Throws InputError where the files' packings differ, the
/// snapshot before is later, or no bond was intact at it.
BondsSince bonds_of_test(const schema::FileReader& file, int snapshot, const schema::FileReader& before,
                         int snapshot_before);

/// Growth of the area-weighted mean damage, of the bonds that were intact at snapshot `snapshot_before` of `before`,
/// up to snapshot `snapshot` of `file`. The details hold both means, the broken share, the damage energy over the
/// energy that breaks them, and the same for the bonds formed since. Uncertainty: as of `damage`, by pairs of grains.
/// Throws InputError as bonds_of_test does.
Measurement measure_damage_of_test(const schema::FileReader& file, int snapshot, const schema::FileReader& before,
                                   int snapshot_before);

} // namespace mpfem
