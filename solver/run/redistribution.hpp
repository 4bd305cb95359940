#pragma once
// When the grains of a run are redistributed among the ranks: if one rank has more work than the others, another
// division is better, and the rest of the run is long enough. The run then reads its last checkpoint again, with other
// owners.

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/run/balance.hpp"
#include "solver/run/run_options.hpp"
#include "solver/run/run_report.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

/// Which rank owns each grain ([grains]); none: by the number of tets.
using Owners = std::optional<std::vector<std::int32_t>>;

/// Measures the work of the ranks from one call to the next. All arguments must outlive it.
class Redistribution {
public:
  /// `reload`: s of wall-clock time that reading and preparing takes.
  Redistribution(const Simulation& simulation, const RunReport& report, Redistribute redistribute, double reload);

  /// Collective. New owners of the grains if redistributing pays or is done always, otherwise none.
  /// `remaining`: s that the rest of the run takes if nothing changes; that of the first rank counts.
  Owners new_owners(double remaining);

private:
  Owners owners_by_work(double remaining);
  Owners owners_in_turn() const;

  const Simulation& simulation_;
  const RunReport& report_;
  Redistribute redistribute_;
  double reload_;                   ///< s
  std::int64_t measured_from_step_; ///< the step of the last measurement
  BusyTime busy_before_;            ///< at that measurement
};

} // namespace mpfem
