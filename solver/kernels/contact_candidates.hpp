#pragma once
// When candidates are searched for again, and what their points keep.

#include <span>

#include "solver/kernels/contact_state.hpp"
#include "solver/model/model.hpp"
#include "solver/physics/damping.hpp"

namespace mpfem {

/// Where a search looks.
struct SearchRange {
  double margin = 0;              ///< mm, up to which candidates are valid: Contact::margin
  double reach = 0;               ///< mm, from nodes to facets: larger, as contact points lie behind nodes
  std::span<const Bounds> bounds; ///< [grains], of the surfaces at present
  const NearGrains& near;         ///< grains whose nodes are searched, and the others near each
};

/// Searches again and resets the points' running state, except bonds and friction. The pairs of `contact` must be those
/// of grains in range.near.
void renew_candidates(const Model& model, const SearchRange& range, ThreadTeam& team, Contact& contact);

/// mm, by which the travel of a grain grows in a step: half of the largest distance by which two points can approach
/// each other that are no farther apart than the margin, if the nodes of both grains move at up to `relative_speed`
/// (mm/s) relative to the affine velocity field v(x). Its strain rate brings such points together at up to
/// max |dv/dx| times the margin. So grains that follow the walls do not count as travelling, however large the box.
double travel_in_step(const Contact& contact, const Advance& update, double relative_speed);

/// mm, since the search.
double travel_since_search(const Contact& contact, std::size_t grain);
/// mm, the largest of all grains.
double largest_travel_since_search(const Contact& contact);
/// True when two points may have approached by more than the candidates' margin; `travel` (mm) is the largest of all
/// grains since the search.
bool search_is_due(const Contact& contact, double travel);

/// Keeps only the pairs whose first grain is the rank's own, with the state of their points.
void leave_own_pairs(const Model& model, Contact& contact);

/// Adds pairs whose first grain is another rank's, sorted as candidates are; their points begin without state.
void add_pairs(const Model& model, const ContactCandidates& others, Contact& contact);

} // namespace mpfem
