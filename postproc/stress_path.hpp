#pragma once
// Where a run went in the plane of mean and deviatoric stress.

#include "postproc/history_table.hpp"
#include "postproc/measurement.hpp"

namespace mpfem {

/// Stresses at the end, their largest values, the largest |q| over p where p is at least a quarter of its largest value
/// (before, grains still move past one another and few contacts decide), and what was dissipated, over all rows.
Measurement stress_path(const HistoryTable& history);

/// Throws InputError.
Measurement measure_stress_path(const schema::FileReader& file);

} // namespace mpfem
