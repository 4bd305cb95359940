#pragma once
// Contacts and bonds as a whole through a run: areas, coordination, damage.

#include <optional>
#include <vector>

#include "postproc/history_table.hpp"
#include "postproc/measurement.hpp"

namespace mpfem {

/// A row a history row: time, stage, relative density, mean stress, axial strain; contact_area_ratio (area in contact
/// with other grains over total surface area, both sides counted in both: the paper's Fig. 13b) and bonded_area_ratio
/// (0 where the surface is not known); coordination number, bonds, mean damage, damage dissipation (mJ).
std::vector<Column> contact_history(const HistoryTable& history);

/// Contact-area ratio at the end of stage `number` (default: the last); at its beginning in the details, with
/// coordination, bonds and damage of both, each with its uncertainty: row_uncertainty, of the damage dissipation
/// energy_uncertainty.
Measurement measure_contact(const schema::FileReader& file, std::optional<int> number);

} // namespace mpfem
