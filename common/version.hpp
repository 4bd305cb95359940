#pragma once

#include <string_view>

namespace mpfem {

/// Version of the toolkit, as in the top CMakeLists.txt ("0.1.0").
std::string_view version();

} // namespace mpfem
