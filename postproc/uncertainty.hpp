#pragma once
// How well numbers are known that are read off single rows of a history: one rule for each kind of number. All are half
// of a 95 % interval, in the number's own unit. What they cover is vibration (ringing) of the rows, their spacing, and
// for energies the error of the ledger; not the mesh, the rate of loading or another packing.

#include <span>
#include <string_view>

#include "postproc/measurement.hpp"
#include "postproc/stages.hpp"
#include "postproc/statistics.hpp"

namespace mpfem {

/// The seven rows of `allowed` that lie nearest to `row`, all where there are fewer.
RowRange rows_about(std::size_t row, RowRange allowed);

/// Of the value in one row, from a few rows about it: Student's t times the standard deviation of their values y about
/// their least-squares parabola over x: a steady change of the value counts for nothing. 0 below four rows, which say
/// nothing.
double row_uncertainty(std::span<const double> x, std::span<const double> y);

/// The same of row `row` of a history's column, by the seven rows of its stage (`allowed`) nearest to it, over time.
double row_uncertainty(const HistoryTable& history, std::span<const double> column, std::size_t row, RowRange allowed);

/// Of column y where x, linear between two rows, reaches `target` at `at`: the rule above for the seven rows of
/// `allowed` nearest to it, y over x (a mean of two rows with weights f and 1 - f scatters by hypot(f, 1 - f) of one),
/// and what the parabola says otherwise, as hypotenuse. Below four rows half of y's change between the two.
double interpolation_uncertainty(std::span<const double> x, std::span<const double> y, Crossing at, double target,
                                 RowRange allowed);

/// Of a value at a turning point of the loading, which lies within half a row of `row`: half of the larger change to
/// the rows before and after.
double turning_point_uncertainty(std::span<const double> column, std::size_t row);

/// Of an energy of the ledger (mJ) in row `row` of its stage: row_uncertainty and the ledger's residual in that row as
/// hypotenuse. The residual is the sum of all terms' errors; which of them err is not known, so each is given the
/// whole, but for the energies of bonds: closed forms of what each bond remembers, which take no sums over steps
/// (solver/physics/bond.hpp).
double energy_uncertainty(const HistoryTable& history, std::string_view energy, std::size_t row, RowRange stage);

/// Of the change of an energy (mJ) from the stage's first row to its last: row_uncertainty of both rows and, but for
/// bonds, the change of the ledger's residual between them, as hypotenuse.
double energy_change_uncertainty(const HistoryTable& history, std::string_view energy, RowRange stage);

/// Adds a note where a stage has so few rows that row_uncertainty stands at 0 for want of them.
void note_short_stage(Measurement& measurement, RowRange stage);

} // namespace mpfem
