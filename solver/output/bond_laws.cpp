#include "solver/output/bond_laws.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

namespace {

/// The number of a softening law in files (results-schema/schema.toml).
double number_of(SofteningLaw law) {
  switch (law) { // no default: the compiler asks for a new law's number
  case SofteningLaw::exponential:
    return 0;
  case SofteningLaw::energy:
    return 1;
  }
  throw std::logic_error("unknown softening law");
}

SofteningLaw softening_of(double number) {
  for (const SofteningLaw law : softening_laws)
    if (number_of(law) == number) return law;
  throw InputError(fmt::format("bond/laws: found the softening law {:g}, allowed: 0 (exponential) or 1 (energy); the "
                               "file was written by another version of mpfem",
                               number));
}

} // namespace

std::vector<double> flatten(std::span<const BondLaw> laws) {
  std::vector<double> numbers;
  for (const BondLaw& law : laws)
    numbers.insert(numbers.end(), {law.tensile_strength, law.shear_strength, law.fracture_energy,
                                   number_of(law.softening), law.stiffness, law.penalty_ratio});
  return numbers;
}

std::vector<BondLaw> unflatten_bond_laws(std::span<const double> values, bool normal_only) {
  std::vector<BondLaw> laws;
  for (std::size_t i = 0; i + 6 <= values.size(); i += 6)
    laws.push_back({.stiffness = values[i + 4],
                    .tensile_strength = values[i],
                    .shear_strength = values[i + 1],
                    .fracture_energy = values[i + 2],
                    .softening = softening_of(values[i + 3]),
                    .normal_only = normal_only,
                    .penalty_ratio = values[i + 5]});
  return laws;
}

} // namespace mpfem
