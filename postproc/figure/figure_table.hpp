#pragma once
// A figure's tables, made from its runs.

#include "postproc/figure/run_graph.hpp"
#include "postproc/figure/text_table.hpp"

namespace mpfem {

/// The folder of results, and their mesh.
struct ResultsFolder {
  std::string path; ///< "out/coarse"
  std::string mesh; ///< "coarse"

  std::string of(const std::string& folder) const;
};

/// The file of a run or a packing. `packing`: that of the mesh.
std::string file_of(const RunInstance& run, const ResultsFolder& results, const std::string& packing);

/// The folder of the figure's results that its file puts beside `results`. Empty where there are none: it names none,
/// or not beside this mesh, they do not exist, or are those of the same settings.
std::string folder_beside(const Figure& figure, const ResultsFolder& results);

/// The cases that a table or a picture shows: those for which the needed runs of other meshes have been made.
std::vector<Case> available_cases(const Figure& figure, const std::vector<std::string>& series,
                                  const std::vector<Filter>& where, const std::vector<std::string>& runs,
                                  const ResultsFolder& results, const Place& place);

/// Names of the runs from which a table is made.
std::vector<std::string> runs_of(const TableSpec& spec);

/// One row per case, or the histories of its runs one after the other. A number that a metric lacks is an empty cell.
/// Throws InputError: a metric's file that is missing or not JSON, a key that it never has.
TextTable make_table(const Figure& figure, const TableSpec& spec, const ResultsFolder& results);

/// For the help: columns of curves beyond those of the history, with name, unit and meaning.
std::string curve_help();

/// Columns in which a row of several packings is the same: its name, and values of the case. Empty if there is none.
std::vector<std::string> columns_of_same_row(const TableSpec& spec);

/// Refuses two rows that are the same in these columns: both are called `name`.
[[noreturn]] void refuse_same_rows(const TableSpec& spec, const std::string& name);

/// Mean and standard deviation (of the sample, N - 1) over packings of the columns `spec.spread`, for each row of the
/// first table, that of the current packing, in its order. Throws InputError where two of its rows are the same in
/// `columns_of_same_row`.
TextTable spread_of(const TableSpec& spec, const std::vector<std::string>& files);

} // namespace mpfem
