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
  /// Approximate: as if all grains were meshed balls.
  double facets() const;
};
/// Reads the numbers, not the mesh; none if the file holds no mesh. Throws InputError if it cannot be read.
PackingCounts read_packing_counts(const std::string& path);

} // namespace mpfem
