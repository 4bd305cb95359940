#pragma once
// Meshing of spheres, for the subcommands that do it.

#include <cstdint>
#include <string>

#include "pack-gen/mesh_checks.hpp"
#include "pack-gen/sphere_file.hpp"

namespace mpfem {

/// How spheres are meshed, and where the packing goes.
struct MeshingOptions {
  std::string input, output; ///< files: input is for messages
  double size = 0;           ///< nominal element size, mm
  std::int64_t seed = 1;     ///< of the meshes' orientations
  int threads = 1;
  bool optimise = true; ///< for a larger time step
  bool quiet = false;   ///< no progress, notes or report
  StepMaterial material{};
};

/// Meshes the spheres and writes the packing. Throws SimulationError if a gap between facets cannot be proven.
void write_meshed(const MeshingOptions& options, const SpherePacking& packing, const PackingOrigin& origin);

} // namespace mpfem
