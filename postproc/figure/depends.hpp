#pragma once
// Rules for make about figures: their files, what each is made from, and the settings of their runs.

#include "postproc/figure/figure_table.hpp"

namespace mpfem {

/// What the rules need besides the figures.
struct DependsRequest {
  ResultsFolder results;
  std::string packing;                    ///< the meshed packing
  std::string description;                ///< file that it was made from
  Settings common_settings;               ///< element, contact surface …: for every run that does not decline them
  std::vector<std::string> commands = {}; ///< of postproc, for metrics; empty: any
};

/// Rules for make (docs/figure-file.md, "What make does"), for all figures together, so that they share runs. Where the
/// settings of a run differ from those in the file next to it, that settings file depends on FORCE.
/// Throws InputError: runs that two figures describe differently, a metric whose command is not among `commands`.
std::string make_rules(const std::vector<Figure>& figures, const DependsRequest& request);

} // namespace mpfem
