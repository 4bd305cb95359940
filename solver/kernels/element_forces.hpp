#pragma once
// The element pass of one grain: stress update and internal forces of all its tetrahedra.

#include "solver/model/model.hpp"

namespace mpfem {

/// Sums of one grain over one element pass.
struct ElementSums {
  double plastic_work = 0;     ///< mJ, in this step
  double viscous_work = 0;     ///< mJ, in this step
  double hypoelastic_work = 0; ///< mJ, in this step (solver/physics/elasticity.hpp)
  double largest_strain = 0;   ///< largest norm of a strain increment
  bool admissible = true;      ///< false if a tet is inverted or a value is not finite

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.plastic_work), visit.sum(s.viscous_work), visit.sum(s.hypoelastic_work);
    visit.largest(s.largest_strain), visit.every(s.admissible);
  }
};

/// Advances stresses over the step that led to the current positions and writes the internal forces (N) of the grain's
/// nodes to model.force, overwriting it. model.velocity is that of the half step just done, `time_step` its length in
/// s.
ElementSums element_forces(Model& model, int grain, double time_step);

} // namespace mpfem
