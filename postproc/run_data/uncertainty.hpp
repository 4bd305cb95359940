#pragma once
// Uncertainty of numbers that are read from single rows of a history: one rule for each kind of number. All are half of
// a 95 % interval, in the number's own unit. They cover vibration (ringing) of the rows, their spacing, and for
// energies the error of the ledger; not the mesh, the loading rate or another packing. NaN stands for "not known".

#include <span>
#include <string_view>

#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// The seven rows of `allowed` nearest to `row`; all of them where there are fewer.
RowRange rows_about(std::size_t row, RowRange allowed);

/// Uncertainty of the value in one row, from a few rows around it: Student's t times the standard deviation of their
/// values y about their least-squares parabola over x, so that a steady change of the value does not count. NaN below
/// four rows, which are too few for an estimate.
double row_uncertainty(std::span<const double> x, std::span<const double> y);

/// The same for row `row` of a history's column, over time, from the seven nearest rows of its stage (`allowed`).
double row_uncertainty(const HistoryTable& history, std::span<const double> column, std::size_t row, RowRange allowed);

/// Uncertainty of column y where x, linear between two rows, reaches `target` at `at`. In quadrature: the rule above
/// for the seven nearest rows of `allowed`, y over x (the mean of two rows with weights f and 1 - f scatters by
/// hypot(f, 1 - f) of one row), and the difference to the parabola. Below four rows: half of y's change between the
/// two.
double interpolation_uncertainty(std::span<const double> x, std::span<const double> y, Crossing at, double target,
                                 RowRange allowed);

/// Uncertainty of a value at a turning point of the loading, which lies within half a row of `row`: half of the larger
/// change to the row before or after.
double turning_point_uncertainty(std::span<const double> column, std::size_t row);

/// Uncertainty of an energy of the ledger (mJ) in row `row` of its stage: row_uncertainty and the ledger's residual in
/// that row, in quadrature. The residual is the sum of all terms' errors; it is not known which terms err, so the whole
/// residual counts for each. The energies of bonds are the exception: they have closed forms in each bond's state and
/// are not summed over steps (solver/physics/bond.hpp).
double energy_uncertainty(const HistoryTable& history, std::string_view energy, std::size_t row, RowRange stage);

/// Uncertainty of the change of an energy (mJ) from the stage's first row to its last, in quadrature: row_uncertainty
/// of both rows and, except for bonds, the change of the ledger's residual between them.
double energy_change_uncertainty(const HistoryTable& history, std::string_view energy, RowRange stage);

/// Adds a note where a stage has too few rows for row_uncertainty, which is then NaN.
void note_short_stage(Measurement& measurement, RowRange stage);

} // namespace mpfem
