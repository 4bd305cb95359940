#pragma once
// Finds, before parsing, text that the TOML parser must not see.

#include <cstddef>
#include <optional>
#include <string_view>

namespace mpfem {

/// Deepest nesting that is read. A recursive parser runs out of stack on deeper nesting.
constexpr std::size_t deepest_toml = 64;

/// The first line (from 1) where brackets, headings and dotted keys together nest deeper than `deepest`; nothing if
/// none does. Brackets and dots within strings and comments do not count.
std::optional<std::size_t> line_nested_too_deep(std::string_view toml, std::size_t deepest = deepest_toml);

/// The first line (from 1) with a letter beyond ASCII outside strings and comments, where TOML allows none; nothing if
/// there is none. toml++ 3.3 looks some of these up in tables that do not hold them, with unpredictable results.
std::optional<std::size_t> line_beyond_ascii(std::string_view toml);

} // namespace mpfem
