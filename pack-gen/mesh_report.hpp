#pragma once
// Quality of a packing's mesh: counts, volume error, tet quality, facet gaps, critical step.

#include <string>

#include "pack-gen/grain_mesh.hpp"

namespace mpfem {

/// Smallest facet gap between grains, or a grain and a wall, and where it was proven. `second` as in SphereGap.
/// Each mesh is bounded by the convex hull of its nodes (for the meshes of mesh_packing it is that hull), so a
/// separating plane between the hulls is a lower bound of the distance of any two facets. For grains whose bounding
/// spheres prove a larger gap no plane is needed.
SphereGap smallest_facet_gap(const SpherePacking& packing, const PackingMesh& mesh, int threads = 1);

/// Quality of a packing's mesh.
struct MeshReport {
  std::size_t grains = 0, nodes = 0, tets = 0;
  double largest_volume_error = 0; ///< relative, over grains
  double total_volume_error = 0;   ///< relative
  double smallest_quality = 0;     ///< 3 inradius/circumradius
  double median_quality = 0;
  double smallest_step = 0; ///< s
  double median_step = 0;   ///< s, median over tets
  std::size_t smallest_step_grain = 0;
  double largest_excess = 0;         ///< largest node distance from a grain's centre over its radius, minus 1
  std::size_t surface_only_tets = 0; ///< tets with all four nodes on the surface
  SphereGap facet_gap;
  StepMaterial material;
  double nominal_size = 0; ///< mm
};

/// Measures a mesh. Throws SimulationError when a tet has no positive volume or a grain's surface is not a closed
/// sphere.
MeshReport report_mesh(const SpherePacking& packing, const PackingMesh& mesh, double nominal_size,
                       const StepMaterial& material, int threads);

/// The report as a table of lines.
std::string report_text(const MeshReport& report);

} // namespace mpfem
