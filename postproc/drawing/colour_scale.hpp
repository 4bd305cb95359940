#pragma once
// Colours for numbers and for grains.

#include <array>
#include <cstdint>

namespace mpfem {

using Colour = std::array<std::uint8_t, 3>;

/// A perceptually ordered scale from dark violet (0) to yellow (1): "viridis" by N. Smith and S. van der Walt (public
/// domain), as a polynomial of degree six that is within 0.01 of it. Values outside 0 … 1 are clamped; NaN is grey.
Colour scale_colour(double fraction);

/// A light colour for a grain: neighbouring numbers differ (hues in steps of the golden angle).
Colour grain_colour(std::int32_t grain);

} // namespace mpfem
