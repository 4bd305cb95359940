#pragma once
// Whether a run can write its files, found out before hours of work.

#include "solver/run/run_options.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Refuses to write over what the run reads or what another run has written, and tries whether the output can be
/// written at all. Throws InputError, and StorageError if nothing can be written there.
void check_output(const Scenario& scenario, const RunOptions& options);

} // namespace mpfem
