#pragma once
// When candidates are searched anew, and what points keep then.

#include "solver/kernels/contact_state.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// Searches anew and resets the points' running state, apart from bonds. `margin` in mm.
void renew_candidates(const Model& model, double margin, ThreadTeam& team, Contact& contact);

/// True when two nodes may have approached by more than the candidates' margin.
bool search_is_due(const Contact& contact);

} // namespace mpfem
