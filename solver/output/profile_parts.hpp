#pragma once
// The parts of a step whose wall-clock time is measured.

#include <array>
#include <cstddef>

namespace mpfem {

/// Parts of a step.
enum class Part : std::size_t { elements, contact, contact_search, integration, surface, step_estimate, output };
/// Number of parts.
inline constexpr std::size_t profile_parts = 7;
/// Their names in tables and run files, in the same order.
inline constexpr std::array<const char*, profile_parts> part_names = {
    "element forces", "contact forces", "contact search", "integration and walls",
    "surface bounds", "step estimate",  "output"};

} // namespace mpfem
