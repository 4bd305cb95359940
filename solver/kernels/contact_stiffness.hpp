#pragma once
// What contact between grains adds to the frequencies of nodes, for the stable step.

#include <span>

#include "solver/kernels/contact_state.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// kappa/m (1/s^2) of a grain's surface nodes into `rate` [nodes]: a bound of what contact adds to the frequency
/// squared (contact_stiffness_bound in solver/physics/penalty.hpp).
void contact_stiffness_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate);

/// Raises `rate` to what a node in contact usually has, so that the step does not jump when one comes into contact.
/// Nodes near a coarser grain get what one of that grain's nodes would add, since these have larger areas.
void raise_to_expected_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate);

} // namespace mpfem
