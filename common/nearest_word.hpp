#pragma once
// The known word that was probably meant by a mistyped one.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpfem {

/// Number of single-letter insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest of `known`, if its distance is at most a third of the longer word's letters (at least one) and it shares
/// a letter with `word`; else nothing. The first of equals wins.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

/// What a message about an unknown word ends with: "; did you mean 'NEAREST'?" or, where none is near,
/// ", allowed: ALL, KNOWN". Empty where nothing is known.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

} // namespace mpfem
