#pragma once
// All observed quantities of a time level.

#include <vector>

#include "solver/kernels/thread_team.hpp"
#include "solver/output/tool_history.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Collective. Sums over all bonds.
BondSums total_bonds(const Simulation& simulation, ThreadTeam& team);

/// Collective. One row of the history, between evaluate_forces() and advance(). `sums`: of all grains, at the last
/// evaluation.
HistoryRow observe_row(const Simulation& simulation, const ForceSums& sums, ThreadTeam& team);

/// What the tools bear, after evaluate_forces().
std::vector<ToolRow> observe_tools(const Tools& tools);

/// Collective. The part of the stresses that inertia balances, for stages that choose their speed.
LoadingRateObservation observe_loading_rate(const Simulation& simulation, ThreadTeam& team);

} // namespace mpfem
