#include "solver/run/stages/sample.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

Sample sample_of(const Model& model) {
  Sample sample;
  for (const double mass : model.mass) sample.mass += mass;
  sample.solid_volume = model.total_reference_volume();
  for (int grain = 0; grain < model.grains; ++grain)
    sample.constrained_modulus += model.material_of(grain).moduli.dilatational() *
                                  model.reference_volume[static_cast<std::size_t>(grain)] / sample.solid_volume;
  for (const double stiffness : model.penalty_stiffness)
    sample.contact_stiffness = std::max(sample.contact_stiffness, stiffness);
  return sample;
}

std::array<double, 3> lengths(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

double volume(const std::array<double, 3>& lengths) {
  return lengths[0] * lengths[1] * lengths[2];
}

double longest(const std::array<double, 3>& lengths) {
  return *std::max_element(lengths.begin(), lengths.end());
}

double wave_transit(const Sample& sample, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  const auto length = lengths(low, high);
  return longest(length) * std::sqrt(sample.mass / (volume(length) * compact_modulus * sample.constrained_modulus));
}

} // namespace mpfem
