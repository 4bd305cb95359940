#include "postproc/run_data/mean_radius.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <Eigen/Dense>

#include "postproc/run_data/snapshot.hpp"
#include "results-schema/packing_file.hpp"

namespace mpfem {

double mean_radius_of_packing(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::packing);
  const auto radius = schema::read_packing_spheres(file).radius;
  return std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
}

std::optional<double> mean_radius_of_run(const schema::FileReader& file) {
  if (file.snapshots().empty()) return {};
  const Snapshot state = read_snapshot(file, 0);
  const auto corner = [&](std::size_t tet, std::size_t local) {
    const auto node = 3 * static_cast<std::size_t>(state.tet[4 * tet + local]);
    return Eigen::Vector3d(state.node[node], state.node[node + 1], state.node[node + 2]);
  };
  std::vector<double> volume(file.rows(schema::run::mesh_grain_tet_offset) - 1);
  double total = 0;
  for (std::size_t tet = 0; tet < state.tets(); ++tet) {
    const Eigen::Vector3d a = corner(tet, 0);
    const double v = (corner(tet, 1) - a).cross(corner(tet, 2) - a).dot(corner(tet, 3) - a) / 6;
    volume[static_cast<std::size_t>(state.tet_grain[tet])] += v;
    total += v;
  }
  double reference = state.relative_density;
  if (file.has(schema::run::history_section_share)) reference *= file.read(schema::run::history_section_share).front();
  for (std::size_t axis = 0; axis < 3; ++axis) reference *= state.box_high[axis] - state.box_low[axis];
  if (!(total > 0) || !(reference > 0)) return {};
  double sum = 0;
  for (const double v : volume) sum += std::cbrt(3 * std::abs(v) * reference / total / (4 * std::numbers::pi));
  return sum / static_cast<double>(volume.size());
}

} // namespace mpfem
