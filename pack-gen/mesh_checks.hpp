#pragma once
// Figures of a tetrahedral mesh: volume, quality, critical time step, boundary.

#include <string>
#include <vector>

#include "pack-gen/tet_mesh.hpp"

namespace mpfem {

/// Elastic constants and density that turn a mesh into time steps.
struct StepMaterial {
  double youngs_modulus = 5000; ///< MPa
  double poissons_ratio = 0.3;  ///< 1
  double density = 1.55e-9;     ///< tonne/mm^3
  double wave_speed() const;    ///< dilatational, mm/s
};

/// Signed volume (mm^3).
double tet_volume(const Point& a, const Point& b, const Point& c, const Point& d);
/// Sum of the signed volumes of all tets (mm^3).
double mesh_volume(const TetMesh& mesh);

/// 3 inradius/circumradius: 1 for the regular tetrahedron, 0 for a flat one.
double tet_quality(const Point& a, const Point& b, const Point& c, const Point& d);

/// Critical step 2/omega of central differences (s), omega the solver's own bound (solver/physics/stable_step.hpp).
double critical_step(const Point& a, const Point& b, const Point& c, const Point& d, const StepMaterial& material);

/// Facets that belong to one tet only, outward. Throws std::logic_error if three tets share a facet.
std::vector<Facet> boundary_facets(const std::vector<Tet>& tet);

/// Whether every edge of the facets is shared by exactly two of them, in opposite directions, and they are the surface
/// of one ball (V - E + F = 2).
bool is_closed_sphere(const std::vector<Facet>& facet);

/// What makes a mesh unusable as a ball, in words; empty when nothing does: closed surface, positive tets, every node
/// used.
std::string ball_defect(const TetMesh& mesh);

} // namespace mpfem
