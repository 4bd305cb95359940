#pragma once
// Penalty contact between grains: every surface node against the facets of the grains near it, both surfaces alike.
//
// Each of the two passes (nodes of A on facets of B, nodes of B on facets of A) carries half of the penalty stiffness.
// A node's force is   f = K/2 A (-gap) n   with its tributary area A in the reference state, so that the energy
// K/2 A gap^2 / 2 is an exact potential (with the current area it would not be); the facet's nodes receive -w_i f, so
// that action equals reaction exactly. The pass is split so that every grain writes to its own nodes only: a grain computes
// the points of its own nodes, and after a barrier every grain collects the reactions on its facets in a fixed order.

#include <cstdint>
#include <span>
#include <vector>

#include "solver/kernels/contact_search.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// One active contact point.
struct ContactForce {
  double force[3];  ///< N, on the node
  double weight[3]; ///< shape functions of the facet's nodes at the foot point
  double stiffness; ///< K/2 A, N/mm
  std::int32_t node;
  std::int32_t facet;
};

/// Sums of a grain's own nodes over one contact pass.
struct ContactSums {
  double energy = 0;      ///< mJ stored in the penalty
  double area = 0;        ///< mm^2 of the grain's surface in contact
  double penetration = 0; ///< largest penetration over h
  int active_points = 0;
};

/// Candidates and the running state of contact points.
struct Contact {
  ContactCandidates candidates;
  double margin = 0;                     ///< mm, of the search that made the candidates
  std::vector<std::int32_t> point_facet; ///< [points]: facet met last, -1 none
  std::vector<double> point_wake;        ///< [points], mm: asleep until the two grains' travel adds up to this
  std::vector<double> point_sure;        ///< [points], mm: point_facet is the closest until travel adds up to this
  std::vector<ContactForce> force;       ///< [points]: active points first within every pair's range
  std::vector<std::int32_t> active;      ///< [pairs]: number of active points
  std::vector<double> travel;            ///< [grains], mm: bound of any node's path length since the run began
  std::vector<double> travel_at_search;  ///< [grains], mm

  std::span<const ContactForce> active_points(std::int32_t pair) const {
    const auto p = static_cast<std::size_t>(pair);
    return {force.data() + candidates.pair_point_offset[p], static_cast<std::size_t>(active[p])};
  }
};

/// Searches anew and resets the points' running state.
void renew_candidates(const Model& model, double margin, ThreadTeam& team, Contact& contact);

/// True when two nodes may have approached by more than the candidates' margin.
bool search_is_due(const Contact& contact);

/// Evaluates the contact points of a grain's own nodes and adds their forces to model.force. Throws SimulationError,
/// naming the pair, where a node is deeper than the search margin.
ContactSums contact_forces(Model& model, Contact& contact, int grain);

/// Adds to model.force the reactions on the grain's facets.
void contact_reactions(Model& model, const Contact& contact, int grain);

/// kappa/m (1/s^2) of a grain's surface nodes into `rate` [nodes]: a bound of what contact adds to the frequency
/// squared. For a point with force k gap and gap = n.(u_s - sum w_i u_i), Cauchy's inequality gives
/// k gap^2 <= 2 k (|u_s|^2 + sum w_i |u_i|^2).
void contact_stiffness_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate);

/// Raises `rate` to what a node in contact has as a rule, so that the step does not jump when one comes into contact.
void raise_to_expected_rate(const Model& model, int grain, std::span<double> rate);

/// Contact of one pair of grains at this moment.
struct PairContact {
  std::int32_t first, second;
  double force[3]; ///< N, of second on first
  double area;     ///< mm^2, mean of both sides
};
std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact);

} // namespace mpfem
