#pragma once
// Cohesive bonds of a scenario: [bond], and the adhesion of tools.

#include <optional>
#include <stdexcept>

#include "solver/physics/bond.hpp"

namespace mpfem {

/// The name of a softening law in scenarios and messages.
inline const char* name_of(SofteningLaw law) {
  switch (law) {
  case SofteningLaw::exponential:
    return "exponential";
  case SofteningLaw::energy:
    return "energy";
  }
  throw std::logic_error("unknown softening law");
}

/// Cohesive bonds that form where grains touch each other or a tool (paper Eqs. 2-7, Table 1).
struct BondParameters {
  double tensile_strength = 0; ///< MPa
  double shear_strength = 0;   ///< MPa, in both tangential directions
  double fracture_energy = 0;  ///< G^c, N/mm, in every mode
  SofteningLaw softening = SofteningLaw::exponential;
  bool rebond_on_contact = false;    ///< a point with a broken bond bonds again once it has opened and closes
  bool normal_only = false;          ///< no resistance against sliding (for comparison with theories of adhesion)
  std::optional<double> stiffness{}; ///< K, MPa/mm; if neither K nor the factor is given: the contact's penalty
  std::optional<double> stiffness_factor{}; ///< K h/E
  bool operator==(const BondParameters&) const = default;
};

} // namespace mpfem
