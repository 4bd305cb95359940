#pragma once
// Text without the blanks around it.

#include <string_view>

namespace mpfem {

/// The text from its first to its last character that is none of `blanks`; empty if it has no other.
inline std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const auto first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

} // namespace mpfem
