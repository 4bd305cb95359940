#pragma once
// The history: rows in memory until a file is written; its columns are those of /history in results-schema.

#include <vector>

#include "results-schema/file.hpp"
#include "solver/output/history_row.hpp"

namespace mpfem {

/// Columns that a history has only if the scenario has what they describe.
struct OptionalColumns {
  bool friction = false;
  bool container = false; ///< of tools
};

/// Writes all rows as /history of a run file.
void write_history(schema::FileWriter& file, const std::vector<HistoryRow>& rows, const OptionalColumns& optional);

/// Rows as plain numbers, one after another, and back (for checkpoints). unflatten throws std::length_error if the
/// numbers are not whole rows.
std::vector<double> flatten(const std::vector<HistoryRow>& rows);
/// The reverse of flatten().
std::vector<HistoryRow> unflatten(const std::vector<double>& values);

} // namespace mpfem
