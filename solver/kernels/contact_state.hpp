#pragma once
// Contact between grains: every surface node against the facets of the grains near it, both surfaces alike.
//
// Each of the two passes (nodes of A on facets of B, nodes of B on facets of A) carries half of the penalty stiffness
// (solver/physics/penalty.hpp). Bonds belong to the same points (solver/physics/bond_kinematics.hpp); an intact bond
// keeps its point among the candidates however far it has opened. Friction belongs to points that are closed
// (solver/physics/friction_kinematics.hpp).

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "solver/kernels/contact_search.hpp"
#include "solver/model/pair_friction.hpp"
#include "solver/physics/bond_kinematics.hpp"
#include "solver/physics/friction_kinematics.hpp"

namespace mpfem {

/// Force of one contact point, from the penalty or from its bond. With friction, the penalty force is that of the stick
/// spring, which acts at the anchor. One cache line, so that one prefetch brings all of it.
struct alignas(64) ContactForce {
  double force[3];         ///< N, on the node
  double weight1, weight2; ///< shape functions of the facet's second and third node where the reaction acts
  double stiffness;        ///< N/mm
  std::int32_t node;       ///< with the facet's nodes: reactions need no look-up
  std::int32_t facet_node[3];
  double weight(int corner) const { return corner == 0 ? 1.0 - weight1 - weight2 : corner == 1 ? weight1 : weight2; }
};
static_assert(sizeof(ContactForce) == 64);

/// Candidates and the running state of contact points.
struct Contact {
  ContactCandidates candidates;
  double margin = 0;                     ///< mm, of the search that made the candidates
  std::vector<std::int32_t> point_facet; ///< [points]: closest facet when last looked at, -1 none
  // A gap up to the margin cannot close faster than both grains travel (travel_in_step). So a point that is open by
  // 10 um need not be looked at before the travel of the two grains has grown by 10 um; nor can another facet become
  // the closest before they have travelled half of its lead.
  std::vector<double> point_open_until;  ///< [points], mm: open until the two grains' travel adds up to this
  std::vector<double> point_facet_until; ///< [points], mm: point_facet is the closest until travel adds up to this
  std::vector<ContactForce> force;       ///< [points]: active points first within every pair's range
  std::vector<std::int32_t> active;      ///< [pairs]: number of active points
  /// Laws by which bonds formed; empty: no bonds, and the arrays below stay empty. New bonds form by the last law; in a
  /// branch it may differ from the law of the bonds in the checkpoint. A law's stiffness is 0 if it follows the point's
  /// penalty (bond_law).
  std::vector<BondLaw> bond_laws;
  bool rebond_on_contact = false;            ///< a point with a broken bond bonds again once it has opened and closes
  std::vector<PointBond> bond;               ///< [points]
  std::vector<ContactForce> bond_force;      ///< [points]: pulling bonds first within every pair's range
  std::vector<std::int32_t> pulling;         ///< [pairs]: number of pulling bonds
  PairFriction friction;                     ///< without any, the array below stays empty
  std::vector<PointFriction> point_friction; ///< [points]
  /// mJ that friction has dissipated so far at points that are no longer candidates, by ordered pair of grains.
  std::map<std::pair<std::int32_t, std::int32_t>, double> friction_of_former_points;
  double last_step = 0;                 ///< s, of the step to the current positions; shows where points came in
  std::vector<double> travel;           ///< [grains], mm, since the run began: see travel_in_step
  std::vector<double> travel_at_search; ///< [grains], mm

  bool bonding() const { return !bond_laws.empty(); }
  bool has_friction() const { return friction.present(); }
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

/// Law by which a bond formed, at a point with this penalty (MPa/mm, of both passes together).
inline BondLaw bond_law(const Contact& contact, const PointBond& bond, double penalty) {
  return law_at_point(contact.bond_laws[static_cast<std::size_t>(bond.law)], penalty);
}

} // namespace mpfem
