#pragma once
// The version of the toolkit, and the commit from which it was built.

#include <string>
#include <string_view>

namespace mpfem {

/// Version of the toolkit, as in the top CMakeLists.txt ("0.2.0").
std::string_view version();

/// The version and the commit of the sources: "0.2.0 (commit 1a2b3c4d5e)", "… and changes" if they differ from it. The
/// version alone if the sources are in no git repository.
std::string version_and_commit();

} // namespace mpfem
