#include "postproc/run_data/mean_radius.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "results-schema/packing_file.hpp"

namespace mpfem {

namespace {

/// As the solver writes it to /provenance/packing_hash.
std::string hash_of_packing(const schema::PackingTets& mesh, const std::vector<double>& box_lengths) {
  const std::uint64_t nodes = hash_values(std::span<const double>(mesh.node)),
                      tets = hash_values(std::span<const std::int32_t>(mesh.tet), nodes);
  return hash_text(schema::hash_of_mesh(tets, mesh.grain_node_offset, box_lengths));
}

/// Whether the run's grains are those of a packing. Spheres without meshes are compared by number.
bool is_packing_of(const schema::FileReader& run, const schema::FileReader& file,
                   const schema::PackingSpheres& spheres) {
  if (file.has(schema::packing::mesh_tet))
    return hash_of_packing(schema::read_packing_tets(file, spheres.radius.size()), spheres.box_lengths) ==
           run.read_scalar(schema::run::provenance_packing_hash);
  return spheres.radius.size() + 1 == run.rows(schema::run::mesh_grain_tet_offset);
}

} // namespace

double mean_radius_of_packing(const std::string& path, const schema::FileReader& run) {
  const schema::FileReader file(path, schema::FileKind::packing);
  const schema::PackingSpheres spheres = schema::read_packing_spheres(file);
  if (!is_packing_of(run, file, spheres))
    throw InputError(fmt::format("{}: is not the packing of {}, allowed: the one that the run began with",
                                 one_line(path), one_line(run.path())));
  const std::vector<double>& radius = spheres.radius;
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
