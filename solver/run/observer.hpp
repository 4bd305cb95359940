#pragma once
// All observed quantities of a time level.

#include <span>
#include <vector>

#include "solver/kernels/thread_team.hpp"
#include "solver/output/tool_history.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Sums over all bonds.
BondSums total_bonds(const Model& model, const Contact& contact, ThreadTeam& team);

/// One row of the history, between evaluate_forces() and advance(). `sums` [grains], of the last passes.
HistoryRow observe_row(const Simulation& simulation, std::span<const GrainSums> sums, ThreadTeam& team);

/// What the tools bear, after evaluate_forces().
std::vector<ToolRow> observe_tools(const Tools& tools);

/// The part of the stresses that inertia balances, for stages that choose their speed.
LoadingRateObservation observe_loading_rate(const Simulation& simulation, ThreadTeam& team);

} // namespace mpfem
