#pragma once
// A self-contained page that shows the grains in three dimensions in any browser.

#include <string>
#include <vector>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

struct ViewData; // view_data.hpp

/// HTML with script, style and data (compressed, base64), without network access. It first shows the snapshot with the
/// largest mean stress. Throws SimulationError where memory does not suffice.
std::string view_page(const ViewData& data, const std::string& title);

/// At most `most` snapshots of a run, evenly spaced, with the first and the last among them (only the last for `most` =
/// 1). Throws InputError where there are none.
std::vector<Snapshot> spread_snapshots(const schema::FileReader& file, int most);

/// The page of a run: at most `most` of its snapshots, with its bonds and contacts. Throws InputError.
std::string view_page_of_run(const schema::FileReader& file, int most, const std::string& title);

/// The text with HTML's special characters escaped, for use in an element or a quoted attribute.
std::string html_text(const std::string& text);

} // namespace mpfem
