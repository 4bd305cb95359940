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

double wave_transit(const Sample& sample, const Cell& cell) {
  return cell.longest() * std::sqrt(sample.mass / (cell.volume() * compact_modulus * sample.constrained_modulus));
}

} // namespace mpfem
