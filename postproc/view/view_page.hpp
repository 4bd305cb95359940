#pragma once
// A page that shows the grains in three dimensions in any browser, with all that it needs inside.

#include <string>
#include <vector>

#include "postproc/snapshot.hpp"

namespace mpfem {

struct ViewData; // view_data.hpp

/// HTML with script, style and data (compressed, base64); asks nothing of a network. It begins with the snapshot of the
/// largest mean stress.
std::string view_page(const ViewData& data, const std::string& title);

/// At most `most` snapshots of a run, evenly spread, the first and the last among them. Throws InputError where there
/// are none.
std::vector<Snapshot> spread_snapshots(const schema::FileReader& file, int most);

/// The page of a run: at most `most` of its snapshots, with its bonds and contacts. Throws InputError.
std::string view_page_of_run(const schema::FileReader& file, int most, const std::string& title);

/// Text with what HTML has another meaning for replaced, so that it may stand in an element or in a quoted attribute.
std::string html_text(const std::string& text);

} // namespace mpfem
