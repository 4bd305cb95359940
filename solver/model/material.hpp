#pragma once
// The constants of a material, of contact and of bonds as the kernels take them, from the parameters of a scenario.

#include <variant>

#include "solver/model/pair_friction.hpp"
#include "solver/physics/bond.hpp"
#include "solver/physics/elasticity.hpp"
#include "solver/physics/hardening.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

using FlowLaw = std::variant<ElasticLaw, PowerLaw, TotalStrainLaw, TableLaw>;

/// Constants of a grain's material.
struct Material {
  ElasticModuli moduli; ///< MPa
  double density;       ///< tonne/mm^3, mass scaling included
  double wave_speed;    ///< dilatational, mm/s, with the scaled density
  FlowLaw flow;
};

/// `parameters` are within the ranges that the reader of scenarios checks.
Material make_material(const MaterialParameters& parameters, double mass_scaling);

/// Coulomb's mu of every pair of `materials` (their number).
PairFriction friction_of_pairs(const ContactParameters& contact, std::size_t materials);

/// The law of bonds to form. Unless the scenario gives a stiffness, it is unset: a point uses its contact's penalty.
BondLaw law_of_bonds(const BondParameters& parameters, const ContactParameters& contact);

} // namespace mpfem
