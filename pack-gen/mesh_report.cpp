#include "pack-gen/mesh_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "pack-gen/container.hpp"
#include "pack-gen/convex_distance.hpp"
#include "pack-gen/neighbours.hpp"
#include "pack-gen/parallel.hpp"

namespace mpfem {

namespace {

using NodeMap = Eigen::Map<const Eigen::Matrix3Xd>;

NodeMap grain_nodes(const PackingMesh& mesh, std::size_t grain) {
  const auto begin = static_cast<std::size_t>(mesh.grain_node_offset[grain]);
  const auto end = static_cast<std::size_t>(mesh.grain_node_offset[grain + 1]);
  return {mesh.node.data() + 3 * begin, 3, static_cast<Eigen::Index>(end - begin)};
}

Eigen::Vector3d vector(const Point& p) {
  return {p[0], p[1], p[2]};
}

} // namespace

namespace {

/// A pair of grains, with a lower bound of its gap: that of the bounding spheres.
struct Pair {
  double bound;
  int first, second;
};

/// Pairs whose bounding spheres (radii `radius`) are at most `gap` apart, and some more, nearest first.
std::vector<Pair> pairs_within(const SpherePacking& packing, const std::vector<double>& radius, double gap) {
  std::vector<Pair> pairs;
  const double largest = *std::max_element(radius.begin(), radius.end());
  for_each_pair_within(packing.center, packing.box, 2 * largest + gap, [&](int i, int j) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    pairs.push_back({(vector(packing.center[b]) - vector(packing.center[a])).norm() - radius[a] - radius[b], i, j});
  });
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::tie(x.bound, x.first, x.second) < std::tie(y.bound, y.first, y.second);
  });
  return pairs;
}

/// Replaces `smallest` by the smallest gap of the pairs if that is smaller.
void measure_pairs(const SpherePacking& packing, const PackingMesh& mesh, const std::vector<Pair>& pairs, int threads,
                   SphereGap& smallest) {
  // Blocks of a fixed length, so that the result does not depend on the number of threads.
  constexpr std::size_t block = 64;
  for (std::size_t begin = 0; begin < pairs.size() && pairs[begin].bound < smallest.gap; begin += block) {
    const std::size_t count = std::min(block, pairs.size() - begin);
    std::vector<double> gap(count);
    for_each_parallel(count, threads, [&](std::size_t m) {
      const auto a = static_cast<std::size_t>(pairs[begin + m].first),
                 b = static_cast<std::size_t>(pairs[begin + m].second);
      gap[m] = convex_distance(grain_nodes(mesh, a), grain_nodes(mesh, b),
                               vector(packing.center[b]) - vector(packing.center[a]))
                   .lower;
    });
    for (std::size_t m = 0; m < count; ++m)
      if (gap[m] < smallest.gap) smallest = {gap[m], pairs[begin + m].first, pairs[begin + m].second};
  }
}

} // namespace

SphereGap smallest_facet_gap(const SpherePacking& packing, const PackingMesh& mesh, int threads) {
  const std::size_t n = packing.radius.size();
  SphereGap smallest{std::numeric_limits<double>::infinity(), -1, -1};
  if (n == 0) return smallest;

  // 1. Walls, and the bounding radius of every grain.
  std::mutex guard;
  std::vector<double> radius(n);
  for_each_parallel(n, threads, [&](std::size_t i) {
    const NodeMap node = grain_nodes(mesh, i);
    radius[i] = std::sqrt((node.colwise() - vector(packing.center[i])).colwise().squaredNorm().maxCoeff());
    const std::lock_guard lock(guard);
    for_each_wall_gap(packing.container(), node, [&](double gap, int wall) {
      if (gap < smallest.gap || (gap == smallest.gap && static_cast<int>(i) < smallest.first))
        smallest = {gap, static_cast<int>(i), -1 - wall};
    });
  });

  // 2. Pairs within a distance that grows until it reaches the smallest gap found: all pairs at once would be too many
  //    where the walls are far away.
  for (double within = *std::max_element(radius.begin(), radius.end());; within *= 2) {
    measure_pairs(packing, mesh, pairs_within(packing, radius, std::min(within, smallest.gap)), threads, smallest);
    if (smallest.gap <= within) return smallest;
  }
}

namespace {

/// What is measured on one grain.
struct GrainReport {
  double volume = 0;       ///< mm^3
  double volume_error = 0; ///< relative
  double step = 0;         ///< s, smallest critical step
  double excess = 0;       ///< how far nodes lie outside the sphere, over its radius
  std::size_t surface_only = 0;
};

/// The mesh of one grain alone, its nodes numbered from 0.
TetMesh grain_mesh(const PackingMesh& mesh, std::size_t grain) {
  TetMesh local;
  const std::int32_t first = mesh.grain_node_offset[grain];
  const NodeMap node = grain_nodes(mesh, grain);
  for (Eigen::Index k = 0; k < node.cols(); ++k) local.node.push_back({node(0, k), node(1, k), node(2, k)});
  for (auto e = static_cast<std::size_t>(mesh.grain_tet_offset[grain]);
       e < static_cast<std::size_t>(mesh.grain_tet_offset[grain + 1]); ++e)
    local.tet.push_back({mesh.tet[4 * e] - first, mesh.tet[4 * e + 1] - first, mesh.tet[4 * e + 2] - first,
                         mesh.tet[4 * e + 3] - first});
  return local;
}

/// Measures a grain; `quality` and `step` are those of its tets.
GrainReport measure_grain(const SpherePacking& packing, const PackingMesh& mesh, std::size_t i,
                          const StepMaterial& material, float* quality, float* step) {
  const TetMesh local = grain_mesh(mesh, i);
  if (const std::string defect = ball_defect(local); !defect.empty())
    throw SimulationError(fmt::format("mesh of grain {} has {}", i, defect));
  std::vector<char> on_surface(local.node.size(), 0);
  for (const Facet& f : boundary_facets(local.tet))
    for (const std::int32_t k : f) on_surface[static_cast<std::size_t>(k)] = 1;
  GrainReport grain;
  grain.step = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < local.tet.size(); ++e) {
    const Tet& t = local.tet[e];
    const auto at = [&](std::size_t k) { return local.node[static_cast<std::size_t>(t[k])]; };
    const double critical = critical_step(at(0), at(1), at(2), at(3), material);
    grain.volume += tet_volume(at(0), at(1), at(2), at(3));
    grain.step = std::min(grain.step, critical);
    step[e] = static_cast<float>(critical);
    quality[e] = static_cast<float>(tet_quality(at(0), at(1), at(2), at(3)));
    grain.surface_only +=
        std::all_of(t.begin(), t.end(), [&](std::int32_t k) { return on_surface[static_cast<std::size_t>(k)] != 0; });
  }
  const double radius = packing.radius[i];
  const double exact = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  grain.volume_error = std::abs(grain.volume / exact - 1);
  const NodeMap node = grain_nodes(mesh, i);
  grain.excess =
      std::sqrt((node.colwise() - vector(packing.center[i])).colwise().squaredNorm().maxCoeff()) / radius - 1;
  return grain;
}

/// Sums and extremes over the grains.
void add_up(const std::vector<GrainReport>& grains, const SpherePacking& packing, MeshReport& report) {
  double volume = 0, exact = 0;
  report.smallest_step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const GrainReport& grain = grains[i];
    volume += grain.volume;
    exact += 4.0 / 3.0 * std::numbers::pi * std::pow(packing.radius[i], 3);
    report.largest_volume_error = std::max(report.largest_volume_error, grain.volume_error);
    report.largest_excess = std::max(report.largest_excess, grain.excess);
    report.surface_only_tets += grain.surface_only;
    if (grain.step < report.smallest_step) {
      report.smallest_step = grain.step;
      report.smallest_step_grain = i;
    }
  }
  report.total_volume_error = std::abs(volume / exact - 1);
}

double median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

} // namespace

MeshReport report_mesh(const SpherePacking& packing, const PackingMesh& mesh, double nominal_size,
                       const StepMaterial& material, int threads) {
  MeshReport report;
  report.grains = packing.radius.size();
  report.nodes = mesh.node.size() / 3;
  report.tets = mesh.tet.size() / 4;
  report.material = material;
  report.nominal_size = nominal_size;
  std::vector<GrainReport> grains(report.grains);
  std::vector<float> quality(report.tets), step(report.tets);
  for_each_parallel(report.grains, threads, [&](std::size_t i) {
    const auto first = static_cast<std::size_t>(mesh.grain_tet_offset[i]);
    grains[i] = measure_grain(packing, mesh, i, material, quality.data() + first, step.data() + first);
  });
  add_up(grains, packing, report);
  report.smallest_quality = static_cast<double>(*std::min_element(quality.begin(), quality.end()));
  report.median_quality = median(quality);
  report.median_step = median(step);
  report.facet_gap = smallest_facet_gap(packing, mesh, threads);
  return report;
}

std::string report_text(const MeshReport& report) {
  const double unit = report.nominal_size / report.material.wave_speed();
  const SphereGap& gap = report.facet_gap;
  std::string text;
  const auto line = [&](std::string_view name, const std::string& value) {
    text += fmt::format("{:<42}{}\n", name, value);
  };
  line("grains, nodes, tetrahedra", fmt::format("{}  {}  {}", report.grains, report.nodes, report.tets));
  line("nominal element size h", fmt::format("{:g} mm", report.nominal_size));
  line("relative volume error, largest of a grain", fmt::format("{:.2e}", report.largest_volume_error));
  line("relative volume error, all grains", fmt::format("{:.2e}", report.total_volume_error));
  line("quality, smallest and median", fmt::format("{:.3f}  {:.3f}   (3 inradius/circumradius, 1 is best)",
                                                   report.smallest_quality, report.median_quality));
  line("tetrahedra with 4 surface nodes", fmt::format("{}", report.surface_only_tets));
  line("nodes outside the sphere by", fmt::format("{:.2f} % of the radius at most", 100 * report.largest_excess));
  line("facet gap, smallest",
       fmt::format("{:.4g} mm   (grain {} and {})", gap.gap, gap.first, neighbour_name(gap.second)));
  line("critical step, smallest", fmt::format("{:.3e} s = {:.3f} h/c   (grain {})", report.smallest_step,
                                              report.smallest_step / unit, report.smallest_step_grain));
  line("critical step, median", fmt::format("{:.3e} s = {:.3f} h/c", report.median_step, report.median_step / unit));
  line(
      "  for this material",
      fmt::format("Young's modulus {:g} MPa, Poisson's ratio {:g}, density {:g} tonne/mm^3, wave speed c = {:.4g} mm/s",
                  report.material.youngs_modulus, report.material.poissons_ratio, report.material.density,
                  report.material.wave_speed()));
  return text;
}

} // namespace mpfem
