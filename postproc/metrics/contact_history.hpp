#pragma once
// Contacts and bonds as a whole through a run: areas, coordination, damage.

#include <optional>
#include <vector>

#include "postproc/run_data/history_table.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// One row per row of the history: time, stage, relative density, mean stress, axial strain; contact_area_ratio (area
/// in contact with other grains over total surface area, both counted on either side of a contact: the paper's Fig.
/// 13b) and bonded_area_ratio (both 0 where the surface is not known); coordination number, bonds, mean damage, damage
/// dissipation (mJ).
std::vector<Column> contact_history(const HistoryTable& history);

/// Contact-area ratio at the end of stage `number` (default: the last). The details hold it at the beginning too, with
/// coordination, bonds and damage at both ends and their uncertainties (row_uncertainty; energy_uncertainty for the
/// damage dissipation). Throws InputError.
Measurement measure_contact(const schema::FileReader& file, std::optional<int> number);

} // namespace mpfem
