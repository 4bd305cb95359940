#pragma once
// Sentences that the plan of a run and the run itself both print.

#include <string>

#include "solver/kernels/contact_forces.hpp"
#include "solver/model/model.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// A forecast of wall-clock time (s): "12 s", "3.5 min", "2 h 40 min", "5.2 days".
std::string wall_time_text(double seconds);
/// What mass scaling does; empty if there is none.
std::string mass_scaling_text(const Scenario& scenario, const Model& model);
/// Which bonds have a law other than that of future bonds; empty if all have the scenario's.
std::string earlier_bonds_text(const Contact& contact);

} // namespace mpfem
