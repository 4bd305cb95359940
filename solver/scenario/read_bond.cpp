#include "solver/scenario/read_bond.hpp"

#include "solver/scenario/ranges.hpp"

namespace mpfem {

BondParameters read_bond(TableReader table) {
  BondParameters bond;
  bond.tensile_strength = table.number("tensile_strength", positive_modulus);
  bond.shear_strength = table.number("shear_strength", positive_modulus);
  bond.fracture_energy = table.number("fracture_energy", positive_energy);
  if (table.choice_or("softening", "exponential", {"exponential", "energy"}) == "energy")
    bond.softening = SofteningLaw::energy;
  bond.stiffness = table.optional_number("stiffness", positive_stiffness);
  bond.stiffness_factor = table.optional_number("stiffness_factor", stiffness_factors);
  if (bond.stiffness && bond.stiffness_factor) table.fail("stiffness", "cannot be used with 'stiffness_factor'");
  bond.rebond_on_contact = table.choice_or("rebond", "never", {"never", "on_contact"}) == "on_contact";
  bond.normal_only = table.boolean_or("normal_only", bond.normal_only);
  table.finish();
  return bond;
}

} // namespace mpfem
