#pragma once
// How far a run is, how long it will take, and what a step costs, as seen by this process.

#include <cstdint>
#include <vector>

#include "solver/run/profile.hpp"
#include "solver/run/programme.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Watches a simulation, which must outlive it, from the moment at which it is made.
class RunPace {
public:
  explicit RunPace(const Simulation& simulation);

  /// Of the stages from the one in which this process began, by the time (of the simulation) that they are expected to
  /// take; 0 … 1.
  double fraction_done() const;
  /// s of wall-clock time until the run is complete, if it goes on as since this was made; 0 if nothing is known yet.
  double remaining() const;
  /// ns of wall-clock time per tet and step; 0 before the first step.
  double nanoseconds_per_tet_step() const;

private:
  const Simulation& simulation_;
  Profile::Clock::time_point start_;
  std::int64_t first_step_, first_stage_;
  std::vector<StageForecast> expected_; ///< of the stages from first_stage_ on
  double done_at_start_;
};

} // namespace mpfem
