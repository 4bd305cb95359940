#pragma once
// The bonds of a snapshot, one by one.

#include <cstdint>
#include <optional>
#include <vector>

#include "results-schema/file.hpp"

namespace mpfem {

/// A bond that exists, or once did: on either side of a contact, of a surface node of one grain to the other grain.
struct BondRow {
  std::int32_t node = 0, grain = 0;      ///< what it binds: the same two in every snapshot and branch of a packing
  std::size_t pair = 0;                  ///< of grains, numbered from 0 as they come
  double area = 0;                       ///< mm^2, what it stands for; > 0
  double damage = 0;                     ///< 0: not damaged so far … 1: broken
  std::optional<double> fracture_energy; ///< N/mm, G^c of its law; none where the scenario does not tell
  std::optional<double> dissipation;     ///< mJ, by damage so far; none in files of earlier versions
  bool broken() const { return damage >= 1; }
  /// mJ: what it dissipates until it is broken. Each side of a contact carries half of the traction.
  std::optional<double> energy_to_break() const {
    return fracture_energy ? std::optional(0.5 * area * *fracture_energy) : std::nullopt;
  }
};

/// Of snapshot `number` (as in snapshot_name). Throws InputError where there is no such snapshot or it has no bonds.
std::vector<BondRow> read_bond_table(const schema::FileReader& file, int number);

/// How many pairs of grains these bonds belong to.
std::size_t pairs_of(const std::vector<BondRow>& bonds);

} // namespace mpfem
