#pragma once
// The energy ledger of a run over time.

#include <vector>

#include "postproc/run_data/history_table.hpp"

namespace mpfem {

/// Time, relative density, every term of the ledger (mJ; friction where the file has it), the residual over the work
/// done up to each row, and kinetic over internal energy (both 0 where the denominator is 0).
std::vector<Column> energy_ledger(const HistoryTable& history);

} // namespace mpfem
