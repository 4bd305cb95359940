#pragma once
// Notes on values of `where` that no row of a table has: what they select would be missing without a word.

#include <string>
#include <vector>

#include "postproc/figure/verdict.hpp"

namespace mpfem {

// A note is "FILE:LINE:COLUMN: key …: WHAT: where: no row of … has COLUMN = VALUE, found: …". None is given where the
// table has no rows or the column has empty cells, so that more may follow, where a case of another mesh has the value,
// and for columns that metrics give, whose values nobody knows before. Limits (at_least, at_most) do not count.

/// Notes on the series of a plot and on its inset.
std::vector<std::string> notes_on_plot(const PlotSpec& plot, FigureData& data);

/// Notes on all fits of the figure.
std::vector<std::string> notes_on_fits(FigureData& data);

/// Notes on the quantities of the statements for this mesh. Those that count rows, or have a value for none, have none.
std::vector<std::string> notes_on_statements(FigureData& data, const std::string& mesh);

/// Notes on the cases that a table selects (`where`).
std::vector<std::string> notes_on_cases(const Figure& figure, const TableSpec& table);

/// Notes on the rows that a table keeps (`keep`), of which `rows` has all.
std::vector<std::string> notes_on_kept(const Figure& figure, const TableSpec& table, const TextTable& rows);

} // namespace mpfem
