#pragma once
// Text that fits in a one-line message, whatever a file or a command line held.

#include <string>
#include <string_view>

namespace mpfem {

/// The text with line ends, tabs and other control characters written as escapes (\n, \t, \x1b …).
std::string one_line(std::string_view text);

} // namespace mpfem
