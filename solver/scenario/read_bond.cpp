#include "solver/scenario/read_bond.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "solver/scenario/ranges.hpp"

namespace mpfem {

namespace {

SofteningLaw read_softening(TableReader& table) {
  std::vector<std::string> names;
  for (const SofteningLaw law : softening_laws) names.emplace_back(name_of(law));
  const std::string name = table.choice_or("softening", name_of(BondParameters{}.softening), names);
  return *std::find_if(std::begin(softening_laws), std::end(softening_laws),
                       [&](SofteningLaw law) { return name == name_of(law); });
}

} // namespace

BondParameters read_bond(TableReader table) {
  BondParameters bond;
  bond.tensile_strength = table.number("tensile_strength", positive_modulus);
  bond.shear_strength = table.number("shear_strength", positive_modulus);
  bond.fracture_energy = table.number("fracture_energy", positive_energy);
  bond.softening = read_softening(table);
  bond.stiffness = table.optional_number("stiffness", positive_stiffness);
  bond.stiffness_factor = table.optional_number("stiffness_factor", stiffness_factors);
  if (bond.stiffness && bond.stiffness_factor) table.fail("stiffness", "cannot be used with 'stiffness_factor'");
  bond.rebond_on_contact = table.choice_or("rebond", "never", {"never", "on_contact"}) == "on_contact";
  bond.normal_only = table.boolean_or("normal_only", bond.normal_only);
  table.finish();
  return bond;
}

} // namespace mpfem
