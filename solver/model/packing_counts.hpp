#pragma once
// How large a packing's mesh is, without reading it.

#include <cstdint>
#include <string>
#include <vector>

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

} // namespace mpfem
