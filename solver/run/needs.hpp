#pragma once
// What a run needs of memory and disk space, predicted from the numbers of nodes and tets before anything is built.

#include <string>

#include "solver/model/packing_counts.hpp"
#include "solver/parallel/communicator.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Bytes.
struct Needs {
  double memory = 0; ///< of one rank: the most that is resident at a time
  double disk = 0;   ///< the most that the run's files take at a time
};
/// Bytes of one row of the history, tools included.
double bytes_of_row(const Scenario& scenario);

/// What a run of the scenario needs at most, in the dense packing, on `ranks` of equal shares. Of several ranks each
/// needs more than its share, because memory pages hold grains of more than one.
Needs needs_of(const PackingCounts& packing, const Scenario& scenario, int ranks = 1);

/// The same, with the numbers of the scenario's packing. Throws InputError at the key 'packing' if its file cannot be
/// read as a packing.
Needs needs_of(const Scenario& scenario, int ranks = 1);

/// Bytes that may be written to the folder of a file. Infinite if the system does not tell.
double available_disk_space(const std::string& file);

/// Empty, or a warning if little or nothing is left over. Throws InputError if the run needs more than there is, by
/// more than the error of the forecast. `purpose` is the beginning of the line: "RUN.h5".
std::string check_needs(const std::string& purpose, const Needs& needs, const Needs& available);

/// Collective. The same for the memory of this rank's machine, which all its ranks share; all ranks throw if that of
/// one machine is too little. `of_rank`: bytes that each rank needs, known to the first rank, 0 on others.
std::string check_memory(const std::string& purpose, double of_rank, const Communicator& ranks);

} // namespace mpfem
