#pragma once
// Which snapshot a number was read from.

#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// Snapshot `number` (as in snapshot_name), with the stage of the history row nearest in time. Throws InputError.
SnapshotWindow snapshot_window(const schema::FileReader& file, int number);

} // namespace mpfem
