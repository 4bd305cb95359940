#pragma once
// Numbers written as text in tables and on the command line.

#include <cstdint>
#include <optional>
#include <string_view>

namespace mpfem {

/// The number that the whole text represents, such as "-1.5e-3". Nothing if there is other text, or no finite number.
std::optional<double> finite_number(std::string_view text);

/// The whole number that the whole text represents, without decimal point. Nothing if it has more than 64 bits.
std::optional<std::int64_t> whole_number(std::string_view text);

} // namespace mpfem
