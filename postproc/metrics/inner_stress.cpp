#include "postproc/metrics/inner_stress.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/metrics/love_weber.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/snapshot_window.hpp"
#include "postproc/run_data/tet_geometry.hpp"

namespace mpfem {

namespace {

constexpr std::size_t octants = 8;

/// One of the eight parts of a region, cut by the planes through its centre.
Region octant(const Region& region, std::size_t number) {
  const Eigen::Vector3d centre = 0.5 * (region.low + region.high);
  Region part = region;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    (number >> axis & 1 ? part.low : part.high)[a] = centre[a];
  }
  return part;
}

/// Half of the 95 % interval (MPa) of the mean stress, from the scatter of the octants.
double scatter_of_octants(const Region& region, std::span<const ForceLine> lines) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < octants; ++i) {
    const double p = love_weber_stress(octant(region, i), lines).trace() / 3;
    sum += p;
    squares += p * p;
  }
  const double variance = std::max(0.0, squares - sum * sum / octants) / (octants - 1);
  return student_t_95(octants - 1) * std::sqrt(variance / octants);
}

/// Every tet with its pressure.
std::vector<PressedVolume> solid_of(const Snapshot& s) {
  const Field& pressure = s.tet_field("pressure");
  std::vector<PressedVolume> solid(s.tets());
  for (std::size_t tet = 0; tet < s.tets(); ++tet) {
    const TetGeometry geometry = tet_geometry(s, tet);
    solid[tet] = {geometry.centre, geometry.volume, pressure.values[tet]};
  }
  return solid;
}

std::vector<ForceLine> lines_between_grains(const schema::FileReader& file, const std::string& name,
                                            std::span<const Eigen::Vector3d> centre) {
  const auto grains = file.read(schema::run::snapshots_pair_grains, name);
  const auto force = file.read(schema::run::snapshots_pair_force, name);
  std::vector<ForceLine> lines;
  for (std::size_t pair = 0; 2 * pair < grains.size(); ++pair)
    lines.push_back({centre[static_cast<std::size_t>(grains[2 * pair])],
                     centre[static_cast<std::size_t>(grains[2 * pair + 1])],
                     {force[3 * pair], force[3 * pair + 1], force[3 * pair + 2]}});
  return lines;
}

/// Adds the walls' normal forces on the grains, and their friction, where the snapshot has them.
void add_lines_to_walls(std::vector<ForceLine>& lines, const schema::FileReader& file, const std::string& name,
                        const Region& box, std::span<const Eigen::Vector3d> centre) {
  if (!file.has(schema::run::snapshots_wall_force, name)) return;
  const auto push = file.read(schema::run::snapshots_wall_force, name);
  const bool rubs = file.has(schema::run::snapshots_wall_friction, name);
  const auto friction =
      rubs ? file.read(schema::run::snapshots_wall_friction, name) : std::vector<double>(2 * push.size(), 0.0);
  for (std::size_t grain = 0; grain < centre.size(); ++grain)
    for (std::size_t side = 0; side < 6; ++side) {
      const double force = push[6 * grain + side];
      if (force == 0) continue;
      const auto axis = static_cast<Eigen::Index>(side / 2);
      const bool low = side % 2 == 0;
      ForceLine line{centre[grain], centre[grain], Eigen::Vector3d::Zero()};
      line.to[axis] = low ? box.low[axis] : box.high[axis];
      line.force[axis] = low ? force : -force;
      for (const Eigen::Index i : {0, 1}) // along the two axes that follow the wall's own
        line.force[(axis + 1 + i) % 3] = friction[12 * grain + 2 * side + static_cast<std::size_t>(i)];
      lines.push_back(line);
    }
}

} // namespace

Measurement measure_inner_stress(const schema::FileReader& file, int snapshot, double share) {
  const Snapshot s = read_snapshot(file, snapshot);
  const std::vector<PressedVolume> solid = solid_of(s);
  const std::vector<Eigen::Vector3d> centre = grain_centres(s);
  const Region box{{s.box_low[0], s.box_low[1], s.box_low[2]}, {s.box_high[0], s.box_high[1], s.box_high[2]}};
  const Region region = inner_region(box, share);
  std::vector<ForceLine> lines = lines_between_grains(file, s.name, centre);
  add_lines_to_walls(lines, file, s.name, box, centre);
  const Eigen::Matrix3d stress = love_weber_stress(region, lines);
  const auto grains = std::count_if(centre.begin(), centre.end(), [&](const auto& x) { return region.contains(x); });
  if (grains == 0)
    throw InputError(
        fmt::format("{}: snapshot {}: no grain has its centre in the inner {:g} of the box, allowed: a larger "
                    "--share",
                    one_line(file.path()), s.name, share));
  Measurement m;
  m.metric = "inner-stress";
  m.value = stress.trace() / 3;
  m.unit = "MPa";
  m.uncertainty = scatter_of_octants(region, lines);
  m.uncertainty_meaning = "half of the 95 % interval of the mean of the region's eight octants";
  m.method = fmt::format("mean stress by Love and Weber of the box's inner {:g} of each length", share);
  m.snapshot = snapshot_window(file, snapshot);
  m.details = {{"mean_stress_of_solid_MPa", solid_mean_stress(region, solid)},
               {"mean_stress_of_walls_MPa", s.mean_stress},
               {"deviatoric_stress_MPa", stress(2, 2) - 0.5 * (stress(0, 0) + stress(1, 1))},
               {"stress_xx_MPa", stress(0, 0)},
               {"stress_yy_MPa", stress(1, 1)},
               {"stress_zz_MPa", stress(2, 2)},
               {"stress_xy_MPa", 0.5 * (stress(0, 1) + stress(1, 0))},
               {"stress_yz_MPa", 0.5 * (stress(1, 2) + stress(2, 1))},
               {"stress_zx_MPa", 0.5 * (stress(2, 0) + stress(0, 2))},
               {"share_of_lengths", share},
               {"grains_centred_inside", grains}};
  m.brief = fmt::format("{:.5g} MPa by the solid, {:.5g} MPa by the walls; {} grains",
                        m.details["mean_stress_of_solid_MPa"].get<double>(), s.mean_stress, grains);
  if (grains < 8)
    m.notes.push_back(
        fmt::format("only {} grains have their centres inside: the value is a mean over few contacts", grains));
  return m;
}

} // namespace mpfem
