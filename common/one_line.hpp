#pragma once
// Text that fits in a one-line message, whatever a file or a command line held.

#include <cstddef>
#include <string>
#include <string_view>

namespace mpfem {

/// The text with line ends, tabs, other control characters and bytes that are not UTF-8 written as escapes (\n, \t,
/// \x1b …).
std::string one_line(std::string_view text);

/// The first characters of a text in UTF-8, at most so many. No character is cut in two.
std::string_view first_characters(std::string_view text, std::size_t most);

/// One line of at most `longest` characters: one_line(text), with "…" for the middle of a longer text.
std::string shortened(std::string_view text, std::size_t longest = 80);

/// A path for a message: one line, long enough for usual paths to be shown whole.
std::string shown_path(std::string_view path);

} // namespace mpfem
