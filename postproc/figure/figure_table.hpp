#pragma once
// A figure's tables, from the numbers of its runs.

#include "postproc/figure/run_graph.hpp"
#include "postproc/figure/text_table.hpp"

namespace mpfem {

/// Where results lie and for which mesh.
struct ResultsFolder {
  std::string path; ///< "out/coarse"
  std::string mesh; ///< "coarse"

  std::string of(const std::string& folder) const;
};

/// The file of a run or a packing. `packing`: that of the mesh.
std::string file_of(const RunInstance& run, const ResultsFolder& results, const std::string& packing);

/// The cases that a table or a picture shows: those of which runs of other meshes that it needs have been made.
std::vector<Case> available_cases(const Figure& figure, const std::vector<std::string>& series,
                                  const std::vector<Filter>& where, const std::vector<std::string>& runs,
                                  const ResultsFolder& results, const Place& place);

/// Names of the runs that a table is made from.
std::vector<std::string> runs_of(const TableSpec& spec);

/// A row a case, or the histories of its runs one after the other. A number that a metric has not is an empty cell.
/// Throws InputError: a metric's file that is missing or no JSON, a key that it never has.
TextTable make_table(const Figure& figure, const TableSpec& spec, const ResultsFolder& results);

/// Columns of curves beyond those of the history: name, unit and meaning, for the help.
std::string curve_help();

/// Mean and standard deviation (of the sample, N - 1) over packings of the columns `spec.spread`, by the rows' names;
/// the first table is that of this packing and says which rows there are.
TextTable spread_of(const TableSpec& spec, const std::vector<std::string>& files);

} // namespace mpfem
