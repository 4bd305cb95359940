#pragma once
// The runs that a figure's cases need: from which checkpoint each begins, and with which settings.

#include <set>

#include "postproc/figure/figure.hpp"

namespace mpfem {

/// One row of a series: its values, and for each value its list.
struct Case {
  std::string series, mesh; ///< mesh: value of MESH
  Words values;
  std::map<std::string, std::vector<Value>> lists;
  const CaseBlock* block = nullptr;
};

/// A run or a packing of one case.
struct RunInstance {
  std::string folder;             ///< in the results' folder; "../OTHER/…" for a run of another mesh
  std::string parent, checkpoint; ///< folder and name of the checkpoint ("D0.920", a stage's name); empty: the packing
  std::string packing;            ///< folder of the packing at which the chain began; empty: that of the mesh
  bool is_packing = false;
  std::string size, command; ///< of a packing
  bool is_made = true;       ///< false: of another mesh, read from there
  std::string programme;
  Settings settings; ///< inherited ones of the chain's first run, then its own
  bool common_settings = true;
  std::set<double> densities; ///< relative densities at which other runs need a checkpoint
};

/// The rows of these series (empty: of all), in the order of the file, with the defaults. Throws InputError where no
/// series of this name exists, or where a row lacks a value of `where`.
std::vector<Case> cases_of(const Figure& figure, const std::vector<std::string>& series,
                           const std::vector<Filter>& where, const std::string& mesh, const Place& place);

/// Names of the stages of a programme, empty for those without one. Throws InputError where it has no stages.
std::vector<std::string> stage_names(const std::string& programme);

/// Runs by folder.
using RunGraph = std::map<std::string, RunInstance>;

/// True if a run or packing is meant for this case.
bool belongs_to(const RunTemplate& run, const Case& row);

/// The folder of a figure's file, "." for one in the current folder: {here} in its commands.
std::string folder_of_file(const std::string& path);

/// The folder of a case's run, in the results' folder: as given in the file, otherwise "FIGURE/runs/RUN-VALUE-VALUE…"
/// with the values of the case on which the run depends.
std::string folder_of(const Figure& figure, const RunTemplate& run, const Case& row);

/// Whether two runs have the same settings, packing and beginning.
bool same_run(const RunInstance& a, const RunInstance& b);

/// Adds a case's run and all runs at which it begins. Throws InputError: invalid chains, a folder that a run with other
/// settings has too.
const RunInstance& add_run(RunGraph& graph, const Figure& figure, const RunTemplate& run, const Case& row);

/// Adds the runs of one graph to another. Throws InputError, naming `name`, where a folder stands for different runs.
void add_runs(RunGraph& graph, const RunGraph& others, const std::string& name);

} // namespace mpfem
