#include "solver/model/material.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

namespace {

FlowLaw make_flow_law(const MaterialParameters& p) {
  const HardeningParameters& h = p.hardening;
  switch (h.law) {
  case HardeningLaw::elastic:
    return ElasticLaw{};
  case HardeningLaw::power:
    return PowerLaw{h.yield_stress, h.coefficient, h.exponent};
  case HardeningLaw::total_strain:
    return TotalStrainLaw{h.coefficient, h.exponent, p.youngs_modulus};
  case HardeningLaw::table: {
    TableLaw law;
    law.points = static_cast<int>(h.table_plastic_strain.size());
    std::copy(h.table_plastic_strain.begin(), h.table_plastic_strain.end(), law.strain.begin());
    std::copy(h.table_flow_stress.begin(), h.table_flow_stress.end(), law.stress.begin());
    return law;
  }
  }
  return ElasticLaw{};
}

} // namespace

Material make_material(const MaterialParameters& parameters, double mass_scaling) {
  const ElasticModuli moduli = elastic_moduli(parameters.youngs_modulus, parameters.poissons_ratio);
  const double density = parameters.density * mass_scaling;
  return {moduli, density, std::sqrt(moduli.dilatational() / density), make_flow_law(parameters)};
}

PairFriction friction_of_pairs(const ContactParameters& contact, std::size_t materials) {
  PairFriction friction(materials, contact.friction);
  for (const MaterialPair& pair : contact.pairs) friction.set(pair.materials[0], pair.materials[1], pair.friction);
  return friction;
}

BondLaw law_of_bonds(const BondParameters& parameters, const ContactParameters& contact) {
  return {.stiffness = parameters.stiffness.value_or(0),
          .tensile_strength = parameters.tensile_strength,
          .shear_strength = parameters.shear_strength,
          .fracture_energy = parameters.fracture_energy,
          .softening = parameters.softening,
          .normal_only = parameters.normal_only,
          .penalty_ratio = parameters.stiffness_factor ? *parameters.stiffness_factor / contact.stiffness_factor : 1.0};
}

} // namespace mpfem
