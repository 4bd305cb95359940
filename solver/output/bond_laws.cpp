#include "solver/output/bond_laws.hpp"

namespace mpfem {

std::vector<double> flatten(std::span<const BondLaw> laws) {
  std::vector<double> numbers;
  for (const BondLaw& law : laws)
    numbers.insert(numbers.end(),
                   {law.tensile_strength, law.shear_strength, law.fracture_energy,
                    law.softening == SofteningLaw::energy ? 1.0 : 0.0, law.stiffness, law.penalty_ratio});
  return numbers;
}

std::vector<BondLaw> unflatten_bond_laws(std::span<const double> values, bool normal_only) {
  std::vector<BondLaw> laws;
  for (std::size_t i = 0; i + 6 <= values.size(); i += 6)
    laws.push_back({.stiffness = values[i + 4],
                    .tensile_strength = values[i],
                    .shear_strength = values[i + 1],
                    .fracture_energy = values[i + 2],
                    .softening = values[i + 3] != 0 ? SofteningLaw::energy : SofteningLaw::exponential,
                    .normal_only = normal_only,
                    .penalty_ratio = values[i + 5]});
  return laws;
}

} // namespace mpfem
