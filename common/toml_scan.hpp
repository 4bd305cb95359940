#pragma once
// What a TOML text holds that its parser must not see: found before it is parsed.

#include <cstddef>
#include <optional>
#include <string_view>

namespace mpfem {

/// Deepest nesting that is read. A parser that follows deeper ones by recursion runs out of stack.
constexpr std::size_t deepest_toml = 64;

/// The first line (from 1) where brackets, headings and dotted keys together nest deeper than `deepest`; nothing where
/// none does. Brackets and dots within strings and comments do not count.
std::optional<std::size_t> line_nested_too_deep(std::string_view toml, std::size_t deepest = deepest_toml);

/// The first line (from 1) with a letter beyond ASCII outside strings and comments, where TOML has none; nothing where
/// there is none. toml++ 3.3 looks some of these up in tables that do not hold them, which may end in anything.
std::optional<std::size_t> line_beyond_ascii(std::string_view toml);

} // namespace mpfem
