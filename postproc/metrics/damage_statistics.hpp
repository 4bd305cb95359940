#pragma once
// How damage is distributed over the bonds of a snapshot, and how well that is known from the number of contacts.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/history_table.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// What the statistics use of a bond (bond_table.hpp).
struct BondSample {
  std::size_t pair = 0; ///< of grains, numbered from 0 in order of appearance
  double area = 0;      ///< mm^2, tributary area of the node
  double damage = 0;    ///< 0: undamaged … 1: broken
};

/// Percentiles that are reported, in per cent.
constexpr std::array<int, 5> damage_percentiles = {10, 25, 50, 75, 90};

/// Shares and mean are of the area of all bonds ever formed. Half widths are of 95 % intervals, with the pairs of
/// grains as the independent units (bonds of one contact break together): they cover the difference to other packings
/// with as many contacts.
struct DamageStatistics {
  std::size_t bonds = 0, pairs = 0;
  double area = 0;           ///< mm^2, both sides of every contact
  Ratio mean;                ///< area-weighted
  Ratio broken_share;        ///< of the area, damage 1: the solver's value for a broken bond
  Ratio undamaged_share;     ///< of the area, damage 0
  Ratio wholly_broken_pairs; ///< share of the pairs that have only broken bonds
  Ratio between_pairs;       ///< standard deviation of the pairs' area-weighted means, each pair with the same weight
  std::array<Ratio, damage_percentiles.size()> percentile; ///< area-weighted, see damage_percentile
};

/// Needs bonds with positive areas. Means and shares come from ratio_of_sums over the n pairs; a share of 0 or 1 has
/// the half width 3 / n. The half width of a percentile is that of the share below it, read off the distribution on
/// both sides (Woodruff, J. Am. Stat. Assoc. 47 (1952) 635).
DamageStatistics damage_statistics(std::span<const BondSample> bonds);

/// The smallest damage value that at least `share` (0 … 1) of the area does not exceed. `distribution` as from
/// damage_distribution.
double damage_percentile(const std::vector<Column>& distribution, double share);

/// Area-weighted cumulative distribution with the columns `damage` (each value once, ascending) and `area_share`, the
/// share of the area whose damage is not larger.
std::vector<Column> damage_distribution(std::span<const BondSample> bonds);

/// The bonds of a snapshot (numbered as in snapshot_name). Throws InputError where there is no such snapshot or it has
/// no bonds.
std::vector<BondSample> read_bonds(const schema::FileReader& file, int snapshot);

/// damage_statistics of a snapshot; the value is the mean. The details also hold damage by energy (bond_energy.hpp),
/// null where the file lacks the energies. Throws InputError as read_bonds.
Measurement measure_damage(const schema::FileReader& file, int snapshot);

} // namespace mpfem
