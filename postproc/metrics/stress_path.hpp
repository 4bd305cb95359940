#pragma once
// The path of a run in the plane of mean and deviatoric stress.

#include "postproc/run_data/history_table.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// Over all rows: stresses at the end (MPa; the value is the mean stress), their largest values, the largest |q| over p
/// where p is above a quarter of its largest value (before that grains still rearrange and few contacts decide), and
/// the energies dissipated (mJ).
Measurement stress_path(const HistoryTable& history);

/// The same of a file. Throws InputError.
Measurement measure_stress_path(const schema::FileReader& file);

} // namespace mpfem
