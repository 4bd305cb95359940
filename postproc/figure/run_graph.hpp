#pragma once
// From a figure's cases to its runs: which there are, from which checkpoint each begins, and with which settings.

#include <set>

#include "postproc/figure/figure.hpp"

namespace mpfem {

/// One row of a series: its values, and of each the list that it stands in.
struct Case {
  std::string series, mesh; ///< mesh: of MESH
  Words values;
  std::map<std::string, std::vector<Value>> lists;
  const CaseBlock* block = nullptr;
};

/// A run or a packing of one case.
struct RunInstance {
  std::string folder;             ///< below the results' folder; "../OTHER/…" of a run of another mesh
  std::string parent, checkpoint; ///< folder and name of the checkpoint ("D0.920", a stage's name); empty: the packing
  std::string packing;            ///< folder of the packing that the chain began at; empty: that of the mesh
  bool is_packing = false;
  std::string size, command; ///< of a packing
  bool is_made = true;       ///< false: of another mesh, taken where it lies
  std::string programme;
  Settings settings; ///< those of the chain's first run, then its own
  bool common_settings = true;
  std::set<double> densities; ///< relative densities at which others need a checkpoint
};

/// The rows of these series (none: of all), in the order of the file, with the defaults.
/// Throws InputError where a series has no rows.
std::vector<Case> cases_of(const Figure& figure, const std::vector<std::string>& series,
                           const std::vector<Filter>& where, const std::string& mesh, const Place& place);

/// Runs by folder.
using RunGraph = std::map<std::string, RunInstance>;

/// Whether a run or packing is meant for this case.
bool belongs_to(const RunTemplate& run, const Case& row);

/// The folder in which a figure's file lies: {here} in its commands.
std::string folder_of_file(const std::string& path);

/// The folder of a case's run, below the results' folder: as the file says, else "FIGURE/runs/RUN-VALUE-VALUE…" with
/// the values of the case that the run depends on.
std::string folder_of(const Figure& figure, const RunTemplate& run, const Case& row);

/// Adds a case's run and all that it begins at. Throws InputError: chains that are none, a folder that other settings
/// have too.
const RunInstance& add_run(RunGraph& graph, const Figure& figure, const RunTemplate& run, const Case& row);

/// Adds the runs of one graph to another. Throws InputError where a folder stands for different runs.
void add_runs(RunGraph& graph, const RunGraph& others, const std::string& name);

} // namespace mpfem
