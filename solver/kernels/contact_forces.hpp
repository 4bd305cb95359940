#pragma once
// The forces of contact between grains.
//
// Every grain writes to its own nodes only: it evaluates the points of its own nodes, and after a barrier it collects
// the reactions on its facets in a fixed order. A facet's nodes receive -w_i f, so that action equals reaction exactly.
// Grains are evaluated several at a time, which saves waiting for memory and changes no result.

#include <cstdint>
#include <span>

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
  double depth = 0;                ///< mm, largest penetration
  std::int32_t deepest_in = -1;    ///< of one grain's sums: the grain in which that is, or -1
  double friction_energy = 0;      ///< mJ stored in stick springs
  double friction_dissipation = 0; ///< mJ, since the time level before

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.energy), visit.largest(s.penetration), visit.largest(s.depth);
    visit.sum(s.friction_energy), visit.sum(s.friction_dissipation);
  }
};

/// mm, depth of a node inside another grain up to which its closest facet is surely among the candidates: they were
/// searched within the margin.
inline double largest_contact_depth(const Contact& contact) {
  return 0.9 * contact.margin;
}

/// Evaluates the contact points of these grains' own nodes and adds their forces to model.force. `sums`: one for each
/// grain. Forces may be wrong where a depth exceeds largest_contact_depth().
void contact_forces(Model& model, Contact& contact, std::span<const std::int32_t> grains, std::span<ContactSums> sums);
/// The same for one grain.
ContactSums contact_forces(Model& model, Contact& contact, std::int32_t grain);

/// Adds to model.force the reactions on the facets of these grains.
void contact_reactions(Model& model, const Contact& contact, std::span<const std::int32_t> grains);

} // namespace mpfem
