#pragma once
// Admissible ranges of physical quantities, for options, scenarios, descriptions and tables alike. They catch slips of
// the decimal point or of units, and keep finite whatever is computed from several values: volumes, squares, ratios.

#include "common/range.hpp"

namespace mpfem {

inline constexpr Range positive_length = Range::between(1e-12, 1e9);  // mm
inline constexpr Range any_length = Range::between(-1e9, 1e9);        // mm; also coordinates
inline constexpr Range length_of_unit = Range::between(1e-9, 1e9);    // mm, of one unit of an STL file
inline constexpr Range positive_modulus = Range::between(1e-9, 1e12); // MPa; also strengths and flow stresses
inline constexpr Range positive_density = Range::between(1e-18, 1e3); // tonne/mm^3

} // namespace mpfem
