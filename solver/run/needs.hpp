#pragma once
// What a run needs of memory and disk space, foretold from numbers of nodes and tets, before anything is built.

#include <cstdint>
#include <string>
#include <vector>

#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Numbers of nodes and tets in a packing file.
struct PackingCounts {
  std::int64_t nodes = 0;
  std::vector<std::int64_t> tets; ///< [grains]
  std::int64_t all_tets() const;
  /// About: those of grains that are meshed balls.
  double facets() const;
};
/// Reads the numbers, not the mesh; none where the file holds no mesh. Throws InputError where it cannot be read.
PackingCounts read_packing_counts(const std::string& path);

/// Bytes.
struct Needs {
  double memory = 0; ///< the most that is resident at a time
  double disk = 0;   ///< the most that the run's files take at a time
};
/// What a run of the scenario needs at most, in the dense packing.
Needs needs_of(const PackingCounts& packing, const Scenario& scenario);

/// Bytes that may be written to the folder of a file. Infinite where the system does not say.
double available_disk_space(const std::string& file);

/// Empty, or a warning where little or nothing is left over. Throws InputError where the run needs more than there is by
/// more than the forecast's own error. `purpose` is the beginning of the line: "RUN.h5".
std::string check_needs(const std::string& purpose, const Needs& needs, const Needs& available);

} // namespace mpfem
