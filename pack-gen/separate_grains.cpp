#include "pack-gen/separate_grains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "pack-gen/container.hpp"
#include "pack-gen/convex_distance.hpp"
#include "pack-gen/neighbours.hpp"
#include "pack-gen/parallel.hpp"

namespace mpfem {

namespace {

using Eigen::Vector3d;

Vector3d vector(const Point& p) {
  return {p[0], p[1], p[2]};
}

/// Gap of a grain and what limits it: another grain, or -1 - wall as in SphereGap.
struct Clearance {
  double gap = std::numeric_limits<double>::infinity();
  int other = -1;
};

class Separation {
public:
  Separation(const SpherePacking& packing, const PackingMesh& mesh, int threads)
      : packing_(packing), node_(packing.radius.size()), near_(packing.radius.size()) {
    const std::size_t n = node_.size();
    std::vector<double> reach(n);
    for_each_parallel(n, threads, [&](std::size_t i) {
      const auto begin = static_cast<std::size_t>(mesh.grain_node_offset[i]);
      const auto end = static_cast<std::size_t>(mesh.grain_node_offset[i + 1]);
      node_[i] =
          Eigen::Map<const Eigen::Matrix3Xd>(mesh.node.data() + 3 * begin, 3, static_cast<Eigen::Index>(end - begin));
      reach[i] = std::sqrt((node_[i].colwise() - vector(packing.center[i])).colwise().squaredNorm().maxCoeff());
    });
    // Grains whose bounding spheres do not meet are apart in every orientation.
    const double largest = *std::max_element(reach.begin(), reach.end());
    for_each_pair_within(packing.center, packing.box, 2 * largest, [&](int i, int j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if ((vector(packing.center[b]) - vector(packing.center[a])).norm() > reach[a] + reach[b]) return;
      near_[a].push_back(j);
      near_[b].push_back(i);
    });
  }

  Eigen::Matrix3Xd& nodes(std::size_t grain) { return node_[grain]; }
  const Eigen::Matrix3Xd& nodes(std::size_t grain) const { return node_[grain]; }
  const std::vector<int>& near(std::size_t grain) const { return near_[grain]; }

  /// Proven gap of a grain with these nodes; the search ends once it is `enough` or less.
  Clearance clearance(std::size_t grain, const Eigen::Matrix3Xd& nodes, double enough) const {
    Clearance result;
    for_each_wall_gap(packing_.container(), nodes, [&](double gap, int wall) {
      if (gap < result.gap) result = {gap, -1 - wall};
    });
    for (const int other : near_[grain]) {
      if (result.gap <= enough) return result;
      const auto b = static_cast<std::size_t>(other);
      const Vector3d axis = vector(packing_.center[b]) - vector(packing_.center[grain]);
      const double gap = separation(nodes, node_[b], axis);
      if (gap < result.gap) result = {gap, other};
    }
    return result;
  }

private:
  /// Usually the plane across the line of centres separates; only if it does not, the best plane is searched.
  static double separation(const Eigen::Matrix3Xd& first, const Eigen::Matrix3Xd& second, const Vector3d& axis) {
    const Vector3d direction = axis.normalized();
    const double gap = (direction.transpose() * second).minCoeff() - (direction.transpose() * first).maxCoeff();
    return gap > 0 ? gap : convex_distance(first, second, axis).lower;
  }

  const SpherePacking& packing_;
  std::vector<Eigen::Matrix3Xd> node_;
  std::vector<std::vector<int>> near_; ///< grains that some orientation could touch
};

// Both bounds are far above what is needed if the gap leaves any room; they end a hopeless search.
constexpr int most_rounds = 60, orientations = 40;

/// Gaps of the grains that may touch because they or a neighbour were turned; the others have no gap here.
std::vector<Clearance> clearances_of(const Separation& grains, const std::vector<char>& suspect, int threads) {
  std::vector<Clearance> found(suspect.size());
  for_each_parallel(suspect.size(), threads, [&](std::size_t i) {
    if (suspect[i]) found[i] = grains.clearance(i, grains.nodes(i), 0);
  });
  return found;
}

bool touches(const Clearance& clearance) {
  return clearance.gap <= 0;
}

[[noreturn]] void refuse(const std::vector<Clearance>& found, std::size_t first, double nominal_size) {
  const Clearance& worst = found[first];
  throw InputError(fmt::format(
      "size {:g} mm: the meshes of {} grains still touch after {} rounds of rotations, first grain {} and {}: the gap "
      "between the spheres is too small for such a coarse mesh, allowed: a smaller size or a larger smallest_gap",
      nominal_size, std::count_if(found.begin(), found.end(), touches), most_rounds, first,
      neighbour_name(worst.other)));
}

/// Turns a grain to the best of some orientations; the first without touch ends the search. True if the orientation
/// changed. `attempt` counts the orientations tried.
bool turn_apart(Separation& grains, std::size_t grain, int& attempt, const PlaceGrain& place) {
  Eigen::Matrix3Xd best = grains.nodes(grain);
  double best_gap = grains.clearance(grain, best, -std::numeric_limits<double>::infinity()).gap;
  Eigen::Matrix3Xd trial = best;
  bool turned = false;
  for (int t = 0; t < orientations && best_gap <= 0; ++t) {
    place(grain, ++attempt, trial.data());
    const double gap = grains.clearance(grain, trial, best_gap).gap;
    if (gap <= best_gap) continue;
    best_gap = gap;
    best = trial;
    turned = true;
  }
  grains.nodes(grain) = best;
  return turned;
}

} // namespace

std::size_t separate_grains(const SpherePacking& packing, PackingMesh& mesh, double nominal_size, int threads,
                            const PlaceGrain& place) {
  const std::size_t n = packing.radius.size();
  Separation grains(packing, mesh, threads);
  std::vector<int> attempt(n, 0);
  std::vector<char> turned(n, 0), suspect(n, 1);
  for (int round = 0;; ++round) {
    const std::vector<Clearance> found = clearances_of(grains, suspect, threads);
    const auto first = static_cast<std::size_t>(std::find_if(found.begin(), found.end(), touches) - found.begin());
    if (first == n) break;
    if (round == most_rounds) refuse(found, first, nominal_size);
    std::fill(suspect.begin(), suspect.end(), 0);
    for (std::size_t i = first; i < n; ++i) {
      if (!touches(found[i])) continue;
      if (turn_apart(grains, i, attempt[i], place)) turned[i] = 1;
      suspect[i] = 1;
      for (const int other : grains.near(i)) suspect[static_cast<std::size_t>(other)] = 1;
    }
  }
  for_each_parallel(n, threads, [&](std::size_t i) {
    if (!turned[i]) return;
    const Eigen::Matrix3Xd& nodes = grains.nodes(i);
    std::copy(nodes.data(), nodes.data() + nodes.size(),
              mesh.node.data() + 3 * static_cast<std::size_t>(mesh.grain_node_offset[i]));
  });
  return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), 1));
}

} // namespace mpfem
