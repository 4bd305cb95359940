#pragma once
// Admissible ranges of a scenario's values, apart from those that all programs share. Where physics has limits, those
// apply.

#include "common/physical_ranges.hpp"
#include "common/range.hpp"

namespace mpfem {

inline constexpr Range hardening_exponent = Range::between(1e-3, 1);
inline constexpr Range admissible_poissons_ratio{.low = -1, .high = 0.5, .low_open = true, .high_open = true};
/// Relative density above which no mesh holds: nodes pass through each other's grains.
inline constexpr double largest_relative_density = 1.2;
inline constexpr Range target_density{.low = 0, .high = largest_relative_density, .low_open = true};
inline constexpr Range positive_stress = Range::between(1e-12, 1e12);   // MPa
inline constexpr Range stress_or_zero = Range::between(0, 1e12);        // MPa
inline constexpr Range any_stress = Range::between(-1e12, 1e12);        // MPa
inline constexpr Range positive_speed = Range::between(1e-12, 1e12);    // mm/s
inline constexpr Range any_speed = Range::between(-1e12, 1e12);         // mm/s or rad/s
inline constexpr Range positive_time = Range::between(1e-15, 1e9);      // s
inline constexpr Range rate_or_zero = Range::between(0, 1e15);          // 1/s
inline constexpr Range stiffness_factors = Range::between(1e-6, 1e4);   // of E/h
inline constexpr Range positive_stiffness = Range::between(1e-9, 1e18); // MPa/mm
inline constexpr Range positive_energy = Range::between(1e-18, 1e12);   // N/mm
/// mu; above 2, the tangential displacement exceeds twice the depth.
inline constexpr Range friction_or_zero = Range::between(0, 2);
inline constexpr Range strain_or_zero = Range::between(0, 1e3);
/// Largest grain number that a scenario may name.
inline constexpr double most_grains = 1e9;

} // namespace mpfem
