#pragma once
// A surface of triangles: shared edges and corners, and the enclosed volume.
//
// Edge 3 t + k of triangle t goes from its corner k to the next corner. Two triangles of a closed and oriented surface
// share each edge and run along it in opposite directions.

#include <array>
#include <cstdint>
#include <vector>

#include "common/bounds.hpp"
#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Vertices, and triangles as numbers of vertices.
struct TriangleMesh {
  std::vector<Vector3<double>> vertex;               ///< mm
  std::vector<std::array<std::int32_t, 3>> triangle; ///< vertices, counter-clockwise seen from outside the body

  const Vector3<double>& corner(std::size_t t, std::size_t k) const {
    return vertex[static_cast<std::size_t>(triangle[t][k])];
  }
};

/// The edge after, and the edge before, an edge of the same triangle.
constexpr std::int32_t next_edge(std::int32_t edge) {
  return edge % 3 == 2 ? edge - 2 : edge + 1;
}
constexpr std::int32_t edge_before(std::int32_t edge) {
  return edge % 3 == 0 ? edge + 2 : edge - 1;
}

/// Edges that violate the rule of a closed and oriented surface: how many, and one of them (-1: none).
struct EdgeFault {
  std::size_t count = 0;
  std::int32_t example = -1;
};

/// Which edges belong together, and which violate the rule.
struct EdgePairs {
  std::vector<std::int32_t> partner; ///< [triangles * 3]: the other triangle's edge; -1 unless there is exactly one
  EdgeFault open;                    ///< edges of one triangle only
  EdgeFault misoriented;             ///< edges along which two triangles run in the same direction
  EdgeFault non_manifold;            ///< edges of more than two triangles
  bool closed() const { return open.count + misoriented.count + non_manifold.count == 0; }
};
/// Pairs the edges of any mesh, closed or not.
EdgePairs pair_edges(const TriangleMesh& mesh);

/// [triangles]: the shell of each. Shells are the parts that no edge connects, numbered by their first triangle.
/// `partner` is that of a closed surface.
std::vector<std::int32_t> shells(const std::vector<std::int32_t>& partner);

/// [triangles * 3]: for each corner the number of its fan: the triangles around it that follow each other across edges.
/// Two bodies that touch at a vertex each have a fan there. `partner` is that of a closed surface.
std::vector<std::int32_t> corner_fans(const std::vector<std::int32_t>& partner);

/// Bounding box (mm) of all vertices; needs at least one.
Bounds bounds_of(const TriangleMesh& mesh);

/// Diagonal (mm) of a bounding box.
double diagonal(const Bounds& bounds);

/// Normal times area (mm^2), from the two edges at the corner opposite the longest edge, for the least rounding.
Vector3<double> area_vector(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c);
/// The same for triangle `t` of a mesh.
inline Vector3<double> area_vector(const TriangleMesh& mesh, std::size_t t) {
  return area_vector(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
}

/// Share of a triangle in the volume (mm^3) that its closed surface encloses: its tetrahedron with `apex`, which may
/// lie anywhere but must be the same for all triangles.
double volume_share(const TriangleMesh& mesh, std::size_t t, const Vector3<double>& apex);

/// Share of a triangle in the winding number at a point: its solid angle over 4 pi (van Oosterom and Strackee, IEEE
/// Trans. Biomed. Eng. 30, 125, 1983). The sum over a closed and oriented surface is 1 inside and 0 outside.
double winding_share(const TriangleMesh& mesh, std::size_t t, const Vector3<double>& point);

} // namespace mpfem
