#pragma once
// The bonds of a snapshot, one by one.

#include <cstdint>
#include <optional>
#include <vector>

#include "results-schema/file.hpp"

namespace mpfem {

/// A bond, broken or not. It ties a surface node of one grain to another grain; each contact has bonds on both sides.
struct BondRow {
  std::int32_t node = 0, grain = 0;      ///< the two that it ties; the same in every snapshot and branch of a packing
  std::size_t pair = 0;                  ///< of grains, numbered from 0 in order of appearance
  double area = 0;                       ///< mm^2, tributary area of the node; > 0
  double damage = 0;                     ///< 0: undamaged … 1: broken
  std::optional<double> fracture_energy; ///< N/mm, G^c of its law; empty where it is not known
  std::optional<double> dissipation;     ///< mJ, by damage up to now; empty for files of earlier versions
  bool broken() const { return damage >= 1; }
  /// Energy (mJ) that it dissipates until it is broken. Each side of a contact carries half of the traction.
  std::optional<double> energy_to_break() const {
    return fracture_energy ? std::optional(0.5 * area * *fracture_energy) : std::nullopt;
  }
};

/// Reads the bonds of snapshot `number` (as in snapshot_name), those without area left out. Throws InputError where
/// there is no such snapshot, it has no bonds, or they are of nodes or grains that the run does not have.
std::vector<BondRow> read_bond_table(const schema::FileReader& file, int number);

/// Number of grain pairs that these bonds belong to.
std::size_t pairs_of(const std::vector<BondRow>& bonds);

} // namespace mpfem
