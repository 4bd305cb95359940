#pragma once
// How many cores each rank takes on a machine that several ranks share.

#include <span>
#include <string>
#include <vector>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Where the threads of a rank may run.
struct RankPlace {
  std::string machine;    ///< machine_id()
  std::vector<int> cores; ///< their numbers on that machine, ascending
};

/// Number of cores that the rank at `own` has for its threads. A core that several of `all` ranks may use, `own` among
/// them, is shared equally among them. At least 1.
int share_of_cores(const RankPlace& own, std::span<const RankPlace> all);

/// Collective. The same for this rank and all others.
int share_of_cores(const Communicator& ranks);

/// Collective. How many ranks run on the machine of this one.
int ranks_on_this_machine(const Communicator& ranks);

} // namespace mpfem
