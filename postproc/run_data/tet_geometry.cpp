#include "postproc/run_data/tet_geometry.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace mpfem {

namespace {

Eigen::Vector3d corner(const Snapshot& s, std::size_t tet, std::size_t local) {
  const auto node = 3 * static_cast<std::size_t>(s.tet[4 * tet + local]);
  return {s.node[node], s.node[node + 1], s.node[node + 2]};
}

} // namespace

TetGeometry tet_geometry(const Snapshot& s, std::size_t tet) {
  const Eigen::Vector3d a = corner(s, tet, 0), b = corner(s, tet, 1), c = corner(s, tet, 2), d = corner(s, tet, 3);
  return {0.25 * (a + b + c + d), (b - a).cross(c - a).dot(d - a) / 6};
}

std::vector<Eigen::Vector3d> grain_centres(const Snapshot& s) {
  const auto grains = static_cast<std::size_t>(1 + *std::max_element(s.tet_grain.begin(), s.tet_grain.end()));
  std::vector<Eigen::Vector3d> centre(grains, Eigen::Vector3d::Zero());
  std::vector<double> volume(grains, 0.0);
  for (std::size_t tet = 0; tet < s.tets(); ++tet) {
    const TetGeometry solid = tet_geometry(s, tet);
    const auto grain = static_cast<std::size_t>(s.tet_grain[tet]);
    centre[grain] += solid.volume * solid.centre;
    volume[grain] += solid.volume;
  }
  for (std::size_t grain = 0; grain < grains; ++grain)
    if (volume[grain] > 0) centre[grain] /= volume[grain];
  return centre;
}

} // namespace mpfem
