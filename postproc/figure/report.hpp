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

/// Title and question of a README (Markdown): its heading and first paragraph. Throws InputError.
ReportEntry entry_of_readme(const std::string& name, const std::string& path);

/// The page, pictures included. Throws InputError where a verdict is missing.
std::string report_page(const std::vector<ReportEntry>& entries, const std::string& results, const std::string& title);

} // namespace mpfem
