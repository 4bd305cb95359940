#include "postproc/drawing/colour_scale.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

Colour scale_colour(double fraction) {
  static constexpr double coefficient[7][3] = {
      {0.2777273272, 0.0054073445, 0.3340998053},   {0.1050930431, 1.4046135299, 1.3845901626},
      {-0.3308618287, 0.2148475595, 0.0950951630},  {-4.6342304984, -5.7991009733, -19.3324409563},
      {6.2282699364, 14.1799333668, 56.6905526007}, {4.7763849977, -13.7451453777, -65.3530326334},
      {-5.4354558559, 4.6458526122, 26.3124352496}};
  if (std::isnan(fraction)) return {150, 150, 150};
  const double t = std::clamp(fraction, 0.0, 1.0);
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    double value = 0;
    for (int power = 6; power >= 0; --power) value = value * t + coefficient[power][c];
    colour[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  }
  return colour;
}

Colour grain_colour(std::int32_t grain) {
  const double hue = std::fmod(0.6180339887498949 * (grain + 1), 1.0), lightness = 0.55 + 0.12 * (grain % 3);
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double phase = std::cos(2 * M_PI * (hue - static_cast<double>(c) / 3));
    colour[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(lightness + 0.22 * phase, 0.0, 1.0)));
  }
  return colour;
}

} // namespace mpfem
