#pragma once
// What is expected of a scenario's stages before they run, and checks of it: how long they take, whether they can reach
// their targets.

#include <cstdint>
#include <string>
#include <vector>

#include "solver/boundary/cell.hpp"
#include "solver/model/model.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Why a stage that begins at this mean stress (MPa) cannot reach its target, in one line; empty if it can. An
/// unloading may begin at its stress or a little below.
std::string unreachable_stress(const Stage& stage, double mean_stress);

/// What is expected of a stage beforehand.
struct StageForecast {
  double duration = 0;       ///< s
  std::string description{}; ///< what the stage does
  bool end_is_known = true;  ///< false: the end of the stage or of one before it is not known beforehand
  Cell cell{};               ///< at the end
};
/// Forecasts of the stages from `first_stage` on, which begins with the given cell. A target is refused if it cannot be
/// reached from the certain end of the stage before. Throws InputError.
std::vector<StageForecast> forecast(const Scenario& scenario, std::int64_t first_stage, const Cell& cell,
                                    const Model& model);

/// Checks the stages from `first_stage` on before anything moves: every target can be reached from where the stage
/// before ends (as far as that is known beforehand), and no wall moves further in one stable step (s) than a small part
/// of an element. Throws InputError.
void check_stages(const Scenario& scenario, std::int64_t first_stage, const Cell& cell, const Model& model,
                  double stable_step);

} // namespace mpfem
