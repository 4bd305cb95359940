#pragma once
// One HTML page of figures: their questions, pictures and verdicts.

#include <string>
#include <vector>

namespace mpfem {

/// One entry of the page.
struct ReportEntry {
  std::string name;            ///< of its folder below the results' folder
  std::string title, question; ///< plain text
};

/// The page, pictures included, and below the title a page of its own where `view` is not empty (view_page). Throws
/// InputError where a verdict is missing.
std::string report_page(const std::vector<ReportEntry>& entries, const std::string& results, const std::string& title,
                        const std::string& view);

} // namespace mpfem
