#pragma once
// How damage is spread over the bonds of a snapshot, and how surely that is known from so many contacts.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "postproc/history_table.hpp"
#include "postproc/measurement.hpp"
#include "postproc/statistics.hpp"

namespace mpfem {

/// What the statistics take of a bond (bond_table.hpp).
struct BondSample {
  std::size_t pair = 0; ///< of grains, numbered from 0 as they come
  double area = 0;      ///< mm^2, what the bond stands for
  double damage = 0;    ///< 0: not damaged so far … 1: broken
};

/// Percentiles that are told, in per cent.
constexpr std::array<int, 5> damage_percentiles = {10, 25, 50, 75, 90};

/// Shares and mean are of the area of all bonds ever formed. Half widths are of 95 % intervals, the pairs of grains
/// being the independent units (bonds of one contact break together): they tell what other packings of so many contacts
/// would differ by.
struct DamageStatistics {
  std::size_t bonds = 0, pairs = 0;
  double area = 0;           ///< mm^2, both sides of every contact
  Ratio mean;                ///< area-weighted
  Ratio broken_share;        ///< of the area, damage 1: the solver's value for a broken bond
  Ratio undamaged_share;     ///< of the area, damage 0
  Ratio wholly_broken_pairs; ///< share of the pairs, all of whose bonds are broken
  Ratio between_pairs;       ///< standard deviation of the pairs' own area-weighted means, every pair counting alike
  std::array<Ratio, damage_percentiles.size()> percentile; ///< area-weighted, see damage_percentile
};

/// Needs bonds whose areas are positive. Means and shares by ratio_of_sums over the n pairs, a share of 0 or 1 with 3 /
/// n; the half width of a percentile is that of the share below it, read off the distribution on both sides (Woodruff,
/// J. Am. Stat. Assoc. 47 (1952) 635).
DamageStatistics damage_statistics(std::span<const BondSample> bonds);

/// The least damage that so large a share of the area does not exceed. `distribution` as of damage_distribution.
double damage_percentile(const std::vector<Column>& distribution, double share);

/// Area-weighted cumulative distribution: columns `damage`, each value once, ascending, and `area_share`, the share of
/// the area whose damage is not larger.
std::vector<Column> damage_distribution(std::span<const BondSample> bonds);

/// Bonds of a snapshot (numbered as in snapshot_name). Throws InputError where there is no such snapshot or it has no
/// bonds.
std::vector<BondSample> read_bonds(const schema::FileReader& file, int snapshot);

/// damage_statistics of a snapshot; the value is the mean. Beside it damage by energy (bond_energy.hpp), null where the
/// file does not tell it.
Measurement measure_damage(const schema::FileReader& file, int snapshot);

} // namespace mpfem
