#include "pack-gen/container.hpp"

#include "surfaces/stl.hpp"

namespace mpfem {

PlacedSurface place_surface(TriangleMesh mesh) {
  const Bounds bounds = bounds_of(mesh);
  PlacedSurface placed;
  placed.corner_in_file = {bounds.low[0], bounds.low[1], bounds.low[2]};
  placed.lengths = lengths_of(bounds);
  const Vector3<double> low{bounds.low[0], bounds.low[1], bounds.low[2]};
  for (Vector3<double>& corner : mesh.vertex) corner = corner - low;
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) volume += volume_share(mesh, t, mesh.vertex.front());
  TriangulatedSurface surface(mesh, GrainSide::inside);
  placed.container =
      std::make_shared<const SurfaceContainer>(SurfaceContainer{std::move(mesh), std::move(surface), volume});
  return placed;
}

PlacedSurface read_surface(const std::string& path, const std::string& key, double scale) {
  PlacedSurface placed = place_surface(read_stl(path, scale).mesh);
  placed.size = {path, key, scale, placed.lengths};
  return placed;
}

} // namespace mpfem
