#pragma once
// One HTML page of figures: their questions, pictures, verdicts and the runs behind them.

#include <string>
#include <vector>

#include "postproc/figure/report_runs.hpp"

namespace mpfem {

/// A picture of a figure, as its file declares it.
struct CaptionedPicture {
  std::string file;    ///< below the folder of the figure's results: "strength.png"
  std::string caption; ///< plain text, a sentence or two
};

/// The pictures that have a caption: plots, then pictures and scripts of every case, in the order of the file.
/// Throws InputError where a caption names a value that a case has not.
std::vector<CaptionedPicture> captions_of_figure(const Figure& figure, const ResultsFolder& results);

/// One entry of the page.
struct ReportEntry {
  std::string name;            ///< of its folder below the results' folder
  std::string title, question; ///< plain text
  std::string source = {};     ///< the figure's file; empty: no link to it
  std::vector<ReportRun> runs = {};
  std::vector<CaptionedPicture> captions = {}; ///< these pictures come first; the others are named by their files
};

/// What the page is made of and where it will lie: links are relative to that folder.
struct ReportRequest {
  std::string results, title;
  std::string view = {};   ///< a page of its own (view_page), shown below the tables; empty: none
  std::string beside = {}; ///< Markdown file whose title and first table are shown next to the verdicts; empty: none
  std::string page_folder = {};
};

/// The page, pictures included. Throws InputError where a verdict is missing, or the other file has no table.
std::string report_page(const std::vector<ReportEntry>& entries, const ReportRequest& request);

} // namespace mpfem
