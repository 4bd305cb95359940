#pragma once
// Whether the bonds that a test opens lie in a band, like the shear bands of a failing sample.

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// What a test did to the bonds of one pair of grains.
struct PairOpening {
  Eigen::Vector3d place; ///< centre of its bonds, relative to the box: -0.5 … 0.5 along each axis
  double area = 0;       ///< mm^2, bonds that had not opened before
  double opened = 0;     ///< mm^2, of these, bonds that have opened
};

/// A plane slab through the sample.
struct DamageBand {
  Eigen::Vector3d normal{0, 0, 0}; ///< unit vector, in coordinates relative to the box
  double offset = 0;               ///< of its middle plane from the box's centre, relative to the box
  double area_share = 0;           ///< share of the bonds that lies in it, by area
  double opened_share = 0;         ///< share of the opened bonds that lies in it, by area
  double excess = 0;               ///< mm, see band_by_chance
  /// How much more often bonds open in it than in the whole sample.
  double concentration() const { return opened_share / area_share; }
};

/// Of slabs a fifth of the box thick whose normals are 30 to 60 degrees off `axis` (0, 1, 2 for x, y, z), the one with
/// the largest excess of opened bonds, (a - p A)/sqrt(A p (1 - p)), with a and A the opened and the whole area in it
/// and p the opened share of the whole sample. `chance` is how often chance makes one as dense: (n + 1)/(trials + 1),
/// n being the trials in which the opened shares, dealt out anew among the pairs of grains, give at least the same
/// excess. Always the same for the same pairs. Openings in a corner or a half of the sample give a small chance, too.
/// `other_excess` is the largest one of slabs that are not inclined (normals 0 to 20 and 70 to 90 degrees off the
/// axis).
struct BandByChance {
  DamageBand band;
  double chance = 1;
  double other_excess = 0; ///< mm
};
/// Told after each trial which fraction of them is done.
using TrialsDone = std::function<void(double)>;
/// Empty where no bond has opened or all have.
std::optional<BandByChance> band_by_chance(const std::vector<PairOpening>& pairs, int axis, int trials,
                                           const TrialsDone& done = {});

/// How the band is looked for.
struct BandRule {
  double threshold = 0.5; ///< damage at which a bond counts as opened
  int axis = 2;           ///< of compression: 0, 1, 2 for x, y, z
  int trials = 1000;      ///< see band_by_chance
};

/// Concentration of the bonds that a test opens in the densest band: bonds whose damage was below the threshold at
/// snapshot `snapshot_before` of `before` and is not at snapshot `snapshot` of `file`. The details hold the band and
/// how often chance makes one as dense. Throws InputError where no bond has opened, or all have.
Measurement measure_damage_band(const schema::FileReader& file, int snapshot, const schema::FileReader& before,
                                int snapshot_before, const BandRule& rule, const TrialsDone& done = {});

} // namespace mpfem
