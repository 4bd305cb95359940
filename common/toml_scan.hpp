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

} // namespace mpfem
