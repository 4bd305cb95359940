#pragma once
// What is observed of contact between grains: areas, bonds, and the force between two grains.

#include <cstdint>
#include <vector>

#include "solver/kernels/contact_state.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// mm^2 of a grain's surface in contact with other grains.
double contact_area(const Model& model, const Contact& contact, int grain);

/// Sums over bonds at the current time level.
struct BondSums {
  double stored = 0;       ///< mJ
  double dissipated = 0;   ///< mJ, lost to damage so far
  double bonded_area = 0;  ///< mm^2 of both sides with intact bonds, as measured at the start of the run
  double formed_area = 0;  ///< mm^2 of both sides where a bond was ever formed
  double damaged_area = 0; ///< mm^2, integral of the damage over formed_area
  std::int64_t bonds = 0;  ///< intact

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.stored), visit.sum(s.dissipated);
    visit.sum(s.bonded_area), visit.sum(s.formed_area), visit.sum(s.damaged_area), visit.count(s.bonds);
  }
};
/// Sums over the bonds of one ordered pair: those of the first grain's nodes to the second grain.
BondSums bond_sums(const Model& model, const Contact& contact, std::int32_t pair);

/// Sums over the friction of a pair of grains.
struct FrictionSums {
  double stored = 0;     ///< mJ
  double dissipated = 0; ///< mJ, so far

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.stored), visit.sum(s.dissipated);
  }
};

/// mJ that damage has dissipated at one point of a pair's contact so far; `point` as in contact.bond.
double bond_dissipation(const Model& model, const Contact& contact, std::int32_t pair, std::int32_t point);

/// Contact of one pair of grains at this moment.
struct PairContact {
  std::int32_t first, second;
  double force[3]; ///< N, of second on first, bonds included
  double area;     ///< mm^2, mean of both sides
  BondSums bonds;
  FrictionSums friction;
};
/// Collective. Pairs in contact or bonded whose first grain is the rank's own, first < second, in ascending order. Each
/// is the sum over the nodes of both grains.
std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact,
                                       const Communicator& ranks = Communicator());

} // namespace mpfem
