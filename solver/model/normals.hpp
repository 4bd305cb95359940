#pragma once
// Nodal normals and tributary areas of a grain's surface: for building a model and for what is observed of it.

#include <cstddef>
#include <vector>

#include "solver/model/model.hpp"

namespace mpfem {

/// Unit outward normals and tributary areas of a grain's surface nodes at the current positions, computed in packs: a
/// third of the area vectors of all facets around a node, by direction and length. Nodes are numbered as in the model.
class SurfaceNormals {
public:
  SurfaceNormals(const Model& model, int grain);

  /// Unit vector; zero at a node whose facets cancel out or have no area.
  Vector3<double> normal(std::size_t node) const {
    const Row& row = rows_[node - first_];
    return {row.x, row.y, row.z};
  }
  double area(std::size_t node) const { return rows_[node - first_].area; } ///< mm^2

private:
  /// Aligned as packs need it.
  struct alignas(4 * sizeof(double)) Row {
    double x = 0, y = 0, z = 0, area = 0;
  };
  std::size_t first_; ///< node
  std::vector<Row> rows_;
};

} // namespace mpfem
