#pragma once
// How far a run is, how long it will take, and what a step costs, as seen by this process.

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/run/profile.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/stage_forecast.hpp"

namespace mpfem {

/// Where a process began a run.
struct PaceOrigin {
  Profile::Clock::time_point time;
  std::int64_t stage = 0;
  std::vector<StageForecast> expected; ///< of the stages from `stage` on
  double done = 0;                     ///< of these
};

/// Watches a simulation, which must outlive it, from the moment at which it is made.
class RunPace {
public:
  /// `origin` is set if it is empty. A run that goes on with other owners of grains hands over its own, which must
  /// outlive this.
  RunPace(const Simulation& simulation, std::optional<PaceOrigin>& origin);

  /// Of the stages from the one in which this process began, by the time (of the simulation) that they are expected to
  /// take; 0 … 1.
  double fraction_done() const;
  /// s of wall-clock time until the run is complete, if it goes on as since the origin; 0 if nothing is known yet.
  double remaining() const;
  /// ns of wall-clock time per tet and step since this was made; 0 before the first step.
  double nanoseconds_per_tet_step() const;

private:
  const Simulation& simulation_;
  std::optional<PaceOrigin>& origin_;
  Profile::Clock::time_point start_;
  std::int64_t first_step_;
};

} // namespace mpfem
