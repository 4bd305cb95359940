#pragma once
// The runs behind a figure, for the report: how they were set, and how well they went.

#include <filesystem>
#include <string>
#include <vector>

#include "postproc/figure/figure_table.hpp"

namespace mpfem {

/// A run that a figure is made from.
struct ReportRun {
  std::string name;      ///< its folder below the results' folder
  std::string file;      ///< run file, HDF5
  std::string programme; ///< scenario that it began with
};

/// Those that its tables, pictures and scripts ask for, and what they begin at, in the order of their folders, each
/// once; runs of other meshes and packings are left out.
std::vector<ReportRun> runs_of_figure(const Figure& figure, const ResultsFolder& results);

/// A table of settings and provenance (mesh, element, surface, seed, energies, cost), with links to scenario, settings
/// and log where these exist, as seen from `page_folder`. Runs whose file is missing say so. Empty without runs.
std::string runs_table(const std::vector<ReportRun>& runs, const std::filesystem::path& page_folder);

/// "<a href=…>TEXT</a>" to a file as seen from a folder.
std::string link_to(const std::filesystem::path& file, const std::filesystem::path& page_folder,
                    const std::string& text);

} // namespace mpfem
