#pragma once
// Whether a mesh can follow the softening of a bond.

#include <string>
#include <vector>

#include "solver/model/model.hpp"

namespace mpfem {

/// Lengths and limits of bonds on a mesh; the coarsest grain decides.
struct BondResolution {
  double element_size = 0;             ///< h, mm
  double cohesive_zone = 0;            ///< mm, length over which the traction falls to half the strength
  double smallest_fracture_energy = 0; ///< N/mm; up to it the law has no softening branch (solver/physics/bond.hpp)
  double steep_fracture_energy = 0;    ///< N/mm; below it softening is steeper than the element beneath can unload
};

/// What grains are bonded to.
enum class BondPartner {
  grain, ///< of the same stiffness: E* = E/(2(1 - nu^2))
  tool,  ///< rigid: E* = E/(1 - nu^2)
};

/// Collective. With E* of a grain and its partner, strength t and bond stiffness K: the traction of the exponential law
/// falls to half the strength over the length 0.34 . 2 E* G^c/t^2 (the same is taken for the energy law); the area
/// under the branch before damage is t^2/(2K); the exponential law's steepest slope t^2/(G^c - t^2/2K) meets the
/// stiffness E/h of the element at G^c = t^2 h/E + t^2/(2K).
BondResolution bond_resolution(const Model& model, const BondParameters& bond, const ContactParameters& contact,
                               BondPartner partner = BondPartner::grain, const Communicator& ranks = Communicator());

/// Collective. Bonds between grains and to tools. Throws InputError if their stiffness leaves no softening branch;
/// warns, one line each, if the cohesive zone has fewer than three elements or the softening is steeper than the
/// elements.
std::vector<std::string> check_bonds(const Model& model, const Scenario& scenario,
                                     const Communicator& ranks = Communicator());

} // namespace mpfem
