#pragma once
// The forces of contact between grains.
//
// Every grain writes to its own nodes only: it evaluates the points of its own nodes, and after a barrier it collects
// the reactions on its facets in a fixed order. A facet's nodes receive -w_i f, so that action equals reaction exactly.

#include "solver/kernels/contact_candidates.hpp"
#include "solver/kernels/contact_state.hpp"
#include "solver/kernels/contact_stiffness.hpp"
#include "solver/kernels/contact_sums.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// Sums of a grain's own nodes over one contact pass.
struct ContactSums {
  double energy = 0;               ///< mJ stored in the penalty
  double penetration = 0;          ///< largest penetration over h
  double friction_energy = 0;      ///< mJ stored in stick springs
  double friction_dissipation = 0; ///< mJ, since the time level before

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.energy), visit.largest(s.penetration);
    visit.sum(s.friction_energy), visit.sum(s.friction_dissipation);
  }
};

/// Evaluates the contact points of a grain's own nodes and adds their forces to model.force. Throws SimulationError,
/// naming the pair, if a node is deeper than 0.9 of the search margin.
ContactSums contact_forces(Model& model, Contact& contact, int grain);

/// Adds to model.force the reactions on the grain's facets.
void contact_reactions(Model& model, const Contact& contact, int grain);

} // namespace mpfem
