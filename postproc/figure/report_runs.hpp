#pragma once
// The runs of a figure, for the report: their settings and their quality.

#include <filesystem>
#include <string>
#include <vector>

#include "postproc/figure/figure_table.hpp"

namespace mpfem {

/// A run that a figure is made from.
struct ReportRun {
  std::string name;      ///< its folder in the results' folder
  std::string file;      ///< run file, HDF5
  std::string programme; ///< file of its scenario
};

/// The runs that its tables, pictures and scripts use, and those at which these begin, each once, in the order of their
/// folders; without packings and runs of other meshes.
std::vector<ReportRun> runs_of_figure(const Figure& figure, const ResultsFolder& results);

/// An HTML table of settings and provenance (mesh, element, surface, seed, energies, cost), with links to scenario,
/// settings and log where these exist, relative to `page_folder`. For a run whose file is missing it says so. Empty
/// without runs.
std::string runs_table(const std::vector<ReportRun>& runs, const std::filesystem::path& page_folder);

/// The link "<a href=…>TEXT</a>" to a file, relative to a folder.
std::string link_to(const std::filesystem::path& file, const std::filesystem::path& page_folder,
                    const std::string& text);

} // namespace mpfem
