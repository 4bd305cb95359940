#pragma once
// Moves the nodes of a unit ball so that its worst tetrahedron, which sets the time step of the whole packing, gets a
// larger critical step.

#include <cstdint>
#include <vector>

#include "pack-gen/ball_points.hpp"

namespace mpfem {

/// Moves one node at a time, interior nodes freely and surface nodes on the sphere, by pattern search on the sum over
/// the tetrahedra around it of (omega^2)^8, a smooth stand-in for the largest omega. `sweeps` passes over the nodes
/// that touch a tetrahedron with a step below `band` times the smallest. Connectivity is kept. `edge`: mean edge
/// length.
void raise_smallest_step(BallMesh& ball, double edge, int sweeps, double band, std::uint64_t seed);

/// Where a node may move.
enum class NodeFreedom : char { fixed, on_unit_sphere, everywhere };

/// The same for any mesh: one freedom for every node. If sizes vary, `edge` is that of the smallest tetrahedra, which
/// have the smallest step.
void raise_smallest_step(TetMesh& mesh, const std::vector<NodeFreedom>& freedom, double edge, int sweeps, double band,
                         std::uint64_t seed);

/// Smallest critical step of a mesh in units of (1 mm)/(wave speed); the Poisson's ratio is 0.3.
double smallest_unit_step(const TetMesh& mesh);

} // namespace mpfem
