#pragma once
// Penalty contact between grains: every surface node against the facets of the grains near it, both surfaces alike.
//
// Each of the two passes (nodes of A on facets of B, nodes of B on facets of A) carries half of the penalty stiffness.
// A node's force is   f = K/2 A (-gap) n   with its tributary area A in the reference state, so that the energy
// K/2 A gap^2 / 2 is an exact potential (with the current area it would not be); the facet's nodes receive -w_i f, so
// that action equals reaction exactly. The pass is split so that every grain writes to its own nodes only: a grain computes
// the points of its own nodes, and after a barrier every grain collects the reactions on its facets in a fixed order.
// Bonds, where the scenario asks for them, belong to the same points (bonds.hpp); an unbroken bond keeps its point among
// the candidates however far it has opened.

#include <cstdint>
#include <span>
#include <vector>

#include "solver/kernels/bonds.hpp"
#include "solver/kernels/contact_search.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// Force of one contact point, of the penalty or of its bond.
struct ContactForce {
  double force[3];         ///< N, on the node
  double weight1, weight2; ///< shape functions of the facet's second and third node where the reaction acts
  double stiffness;        ///< N/mm
  std::int32_t node;       ///< 64 bytes with the facet's nodes: one cache line, and no look-up where they react
  std::int32_t facet_node[3];
  double weight(int corner) const { return corner == 0 ? 1.0 - weight1 - weight2 : corner == 1 ? weight1 : weight2; }
};

/// Sums of a grain's own nodes over one contact pass.
struct ContactSums {
  double energy = 0;      ///< mJ stored in the penalty
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
  /// Laws by which bonds formed, empty: no bonds, and the arrays below stay empty. The last is that of bonds to come; a branch
  /// may bring another than its checkpoint's bonds have. Their stiffness is unset: it is the point's (bond_law).
  std::vector<BondLaw> bond_laws;
  bool rebond_on_contact = false;       ///< a broken bond's point bonds anew when it has opened and closes again
  std::vector<PointBond> bond;          ///< [points]
  std::vector<ContactForce> bond_force; ///< [points]: pulling bonds first within every pair's range
  std::vector<std::int32_t> pulling;    ///< [pairs]: number of pulling bonds
  std::vector<double> travel;           ///< [grains], mm: bound of any node's path length since the run began
  std::vector<double> travel_at_search; ///< [grains], mm

  bool bonding() const { return !bond_laws.empty(); }
  std::span<const ContactForce> active_points(std::int32_t pair) const {
    const auto p = static_cast<std::size_t>(pair);
    return {force.data() + candidates.pair_point_offset[p], static_cast<std::size_t>(active[p])};
  }
  std::span<const ContactForce> pulling_bonds(std::int32_t pair) const {
    if (bond.empty()) return {};
    const auto p = static_cast<std::size_t>(pair);
    return {bond_force.data() + candidates.pair_point_offset[p], static_cast<std::size_t>(pulling[p])};
  }
};

/// Searches anew and resets the points' running state, apart from bonds.
void renew_candidates(const Model& model, double margin, ThreadTeam& team, Contact& contact);

/// True when two nodes may have approached by more than the candidates' margin.
bool search_is_due(const Contact& contact);

/// Evaluates the contact points of a grain's own nodes and adds their forces to model.force. Throws SimulationError,
/// naming the pair, where a node is deeper than the search margin.
ContactSums contact_forces(Model& model, Contact& contact, int grain);

/// Adds to model.force the reactions on the grain's facets.
void contact_reactions(Model& model, const Contact& contact, int grain);

/// mm^2 of a grain's surface in contact with other grains.
double contact_area(const Model& model, const Contact& contact, int grain);

/// kappa/m (1/s^2) of a grain's surface nodes into `rate` [nodes]: a bound of what contact adds to the frequency
/// squared. For a point with force k gap and gap = n.(u_s - sum w_i u_i), Cauchy's inequality gives
/// k gap^2 <= 2 k (|u_s|^2 + sum w_i |u_i|^2).
void contact_stiffness_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate);

/// Raises `rate` to what a node in contact has as a rule, so that the step does not jump when one comes into contact; nodes near a
/// coarser grain to what one of its nodes would bring, whose stiffness is that of its larger area.
void raise_to_expected_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate);

/// The law of bonds to form, its stiffness unset.
BondLaw law_of_bonds(const BondParameters& parameters);

/// Law by which a bond formed, at a point with this penalty stiffness (MPa/mm, of both passes together).
inline BondLaw bond_law(const Contact& contact, const PointBond& bond, double stiffness) {
  BondLaw law = contact.bond_laws[static_cast<std::size_t>(bond.law)];
  law.stiffness = stiffness;
  return law;
}

/// Sums over bonds at the present time level.
struct BondSums {
  double stored = 0;       ///< mJ
  double dissipated = 0;   ///< mJ, lost to damage so far
  double bonded_area = 0;  ///< mm^2 of both sides carrying unbroken bonds, at the start of the run
  double formed_area = 0;  ///< mm^2 of both sides where a bond was ever formed
  double damaged_area = 0; ///< mm^2, integral of the damage over formed_area
  std::int64_t bonds = 0;  ///< unbroken

  void add(const BondSums& other) {
    stored += other.stored;
    dissipated += other.dissipated;
    bonded_area += other.bonded_area;
    formed_area += other.formed_area;
    damaged_area += other.damaged_area;
    bonds += other.bonds;
  }
};
BondSums bond_sums(const Model& model, const Contact& contact, std::int32_t pair);

/// Contact of one pair of grains at this moment.
struct PairContact {
  std::int32_t first, second;
  double force[3]; ///< N, of second on first, bonds included
  double area;     ///< mm^2, mean of both sides
  BondSums bonds;
};
/// Pairs in contact or bonded, first < second.
std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact);

} // namespace mpfem
