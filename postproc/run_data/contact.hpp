#pragma once
// Contacts between grains at one snapshot.

#include <vector>

#include <nlohmann/json.hpp>

#include "postproc/run_data/history_table.hpp"

namespace mpfem {

/// The contacts of one snapshot, one row per pair of grains.
struct ContactTable {
  double relative_density = 0, mean_stress = 0; ///< 1, MPa
  double contact_area_ratio = 0;  ///< area in contact over total surface, in the history row nearest in time
  double coordination_number = 0; ///< 2 pairs / grains, of all pairs in the columns
  std::vector<Column> columns;    ///< a row per pair: first, second, force_x, _y, _z, force, area, pressure; with
                                  ///< bonds also bonded_area, damage (-1: never bonded), bond_energy,
                                  ///< damage_dissipation; N, mm^2, MPa, mJ
};

/// The contacts of a snapshot (numbered as in snapshot_name). Throws InputError where the run has no such snapshot.
ContactTable contact_table(const schema::FileReader& file, int snapshot);
/// All numbers by name, and the columns as "columns".
nlohmann::ordered_json to_json(const ContactTable& table);

} // namespace mpfem
