#pragma once

#include <string>
#include <string_view>

namespace mpfem {

/// Version of the toolkit, as in the top CMakeLists.txt ("0.1.0").
std::string_view version();

/// That, and the commit of the sources: "0.1.0 (commit 1a2b3c4d5e)", "… and changes" where they differ from it. The
/// version alone where they stand in no git repository.
std::string version_and_commit();

} // namespace mpfem
