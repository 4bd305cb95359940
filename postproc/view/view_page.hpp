#pragma once
// A page that shows the grains in three dimensions in any browser, with all that it needs inside.

#include <string>

#include "postproc/view/view_data.hpp"

namespace mpfem {

/// HTML with script, style and data (compressed, base64); asks nothing of a network. It begins with the snapshot of the
/// largest mean stress.
std::string view_page(const ViewData& data, const std::string& title);

/// At most `most` snapshots of a run, evenly spread, the first and the last among them. Throws InputError where there
/// are none.
std::vector<Snapshot> spread_snapshots(const schema::FileReader& file, int most);

/// Text with what HTML has another meaning for replaced, so that it may stand in an element or in a quoted attribute.
std::string html_text(const std::string& text);

} // namespace mpfem
