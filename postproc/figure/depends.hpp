#pragma once
// Rules for make about figures: their files, what each is made from, and the settings of their runs.

#include <functional>

#include "postproc/figure/figure_table.hpp"

namespace mpfem {

/// What the rules need besides the figures.
struct DependsRequest {
  ResultsFolder results;
  std::string packing;                    ///< the meshed packing
  std::string description;                ///< file that it was made from
  Settings common_settings;               ///< element, contact surface …: for every run that does not decline them
  std::vector<std::string> commands = {}; ///< of postproc, for metrics; empty: any
  std::vector<std::string> meshes = {};   ///< values of MESH; empty: any
  /// Throws InputError for words that postproc refuses, before their files exist. Empty: nothing is refused.
  std::function<void(const std::vector<std::string>&)> check_words = {};
  std::string programmes = {}; ///< folder of the scenarios whose common settings are those of make
  /// Called with a line for each value of another scenario that a common setting replaces. Empty: nobody wants them.
  std::function<void(const std::string&)> note = {};
};

/// Rules for make (docs/figure-file.md, "What make does"), for all figures together, so that they share runs. Where the
/// settings of a run differ from those in the file next to it, that settings file depends on FORCE.
/// Throws InputError: names that are no mesh, runs that two figures describe differently, a metric whose command is not
/// among `commands`, metrics and pictures with options that `check_words` refuses, files that nothing makes.
std::string make_rules(const std::vector<Figure>& figures, const DependsRequest& request);

/// The runs of a figure, with those at which they begin. Throws InputError as make_rules does.
RunGraph runs_of(const Figure& figure, const DependsRequest& request);

} // namespace mpfem
