#pragma once
// One HTML page for several figures: their questions, pictures, verdicts and runs.

#include <functional>
#include <string>
#include <vector>

#include "postproc/figure/report_runs.hpp"

namespace mpfem {

/// A picture of a figure, as declared in its file.
struct CaptionedPicture {
  std::string file;    ///< relative to the folder of the figure's results: "strength.png"
  std::string caption; ///< plain text, a sentence or two
};

/// The pictures with a caption: plots, then pictures and scripts of every case, in the order of the file. Throws
/// InputError where a caption names a value that a case lacks.
std::vector<CaptionedPicture> captions_of_figure(const Figure& figure, const ResultsFolder& results);

/// One entry of the page.
struct ReportEntry {
  std::string name;            ///< name of its folder in the results' folder
  std::string title, question; ///< plain text
  std::string source = {};     ///< the figure's file; empty: no link
  std::vector<ReportRun> runs = {};
  std::vector<CaptionedPicture> captions = {}; ///< these pictures come first; others are named after their files
};

/// The files that the page embeds or links to from the folder of a figure's results: pictures, tables and verdicts.
std::vector<std::string> files_on_page(const ReportEntry& entry, const std::string& folder);

/// Content and place of the page; links are relative to `page_folder`.
struct ReportRequest {
  std::string results, title;
  /// Makes a complete page (view_page) that is shown below the tables, once all verdicts are there; empty: none.
  std::function<std::string()> view = {};
  std::string beside = {}; ///< Markdown file whose title and first table are shown next to the verdicts; empty: none
  std::string page_folder = {};
};

/// The page, with embedded pictures. Throws InputError where a verdict is missing, or the file `beside` has no table.
std::string report_page(const std::vector<ReportEntry>& entries, const ReportRequest& request);

} // namespace mpfem
