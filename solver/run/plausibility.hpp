#pragma once
// Values that no solid has: slips of units, which compute without complaint.

#include <string>
#include <vector>

#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// One line for each density and modulus of the scenario's materials that is far from those of solids, with the unit in
/// which it would be plausible, if there is one.
std::vector<std::string> implausible_values(const Scenario& scenario);

/// The same, to be appended to a refusal that follows from such a value: "; …", or empty.
std::string implausible_values_hint(const Scenario& scenario);

} // namespace mpfem
