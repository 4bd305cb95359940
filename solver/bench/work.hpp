#pragma once
// The least that the parts of a step have to do, in operations and bytes, for comparing their times with the machine's
// limits.
//
// Operations are additions, multiplications, divisions and square roots, counted by letting the laws of physics compute
// with Counted. Bytes are what must be read and written if no part finds data of another part in a cache, and nothing
// unneeded is read: records and rows are counted, not cache lines.

#include "solver/kernels/contact_forces.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// Operations and bytes of one part of a step.
struct Work {
  double operations = 0;
  double bytes = 0;
};

/// One tet in one step while it hardens by the power law, its blocks as the model holds them. Averaged pressures are
/// left out.
Work work_of_tet(const Model& model);

/// All points and bonds of one evaluation of contact forces, with their reactions. Operations: only those of points
/// that touch inside a facet; those of bonds and of points that prove open are left out.
Work work_of_contact(const Contact& contact);

/// One contact search: both surfaces of every pair of grains that has candidates read once, candidates written.
/// Operations: only the distances between the nodes and facets that are found.
Work work_of_search(const Model& model, const ContactCandidates& candidates);

/// The update of velocities and positions of all nodes.
Work work_of_integration(const Model& model);

} // namespace mpfem
