#pragma once
// The energy ledger of a run over time.

#include <vector>

#include "postproc/history_table.hpp"

namespace mpfem {

/// Time, relative density, every term of the ledger (mJ), the residual over the work so far, and kinetic over internal
/// energy (0 where there is none yet).
std::vector<Column> energy_ledger(const HistoryTable& history);

} // namespace mpfem
