#pragma once
// How deep the tables and arrays of a TOML text nest, found before a parser follows them.

#include <cstddef>
#include <optional>
#include <string_view>

namespace mpfem {

/// Deepest nesting that is read. A parser that follows deeper ones by recursion runs out of stack.
constexpr std::size_t deepest_toml = 64;

/// The first line (from 1) where brackets, headings and dotted keys together nest deeper than `deepest`; nothing where
/// none does. Brackets and dots within strings and comments do not count.
std::optional<std::size_t> line_nested_too_deep(std::string_view toml, std::size_t deepest = deepest_toml);

} // namespace mpfem
