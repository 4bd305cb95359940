#include "pack-gen/packing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "pack-gen/inflated_spheres.hpp"
#include "pack-gen/neighbours.hpp"
#include "pack-gen/overlap_minimiser.hpp"
#include "pack-gen/random.hpp"
#include "pack-gen/sphere_tree.hpp"

namespace mpfem {

namespace {

/// Hard inflated spheres that move at random and grow whenever there is room (Monte Carlo compaction). Exchanging two
/// spheres of different size lets the packing forget its arrangement far beyond where moves alone arrest (swap Monte
/// Carlo, Grigera & Parisi, Phys. Rev. E 63, 045102, 2001). Lengths as in OverlapMinimiser.
class HardSphereCompaction {
public:
  HardSphereCompaction(std::vector<Point> position, std::vector<double> radius, const PackingContainer& container,
                       Random& random)
      : site_(std::move(position)), radius_(std::move(radius)), sphere_at_(site_.size()), container_(container),
        random_(random) {
    for (std::size_t i = 0; i < sphere_at_.size(); ++i) sphere_at_[i] = i;
    largest_ = *std::max_element(radius_.begin(), radius_.end());
    rebuild();
    growth_ = room();
  }

  /// Factor on the radii so far; 1 is the aim.
  double growth() const { return growth_; }

  /// Moves until the factor reaches 1 (true), or the spheres stop growing or `sweeps` are used (false).
  template <class Report>
  bool compact(int sweeps, Report report) {
    constexpr int block = 250;
    double growth_before = growth_;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (growth_ >= 1) return true;
      if (sweep % block == 0) {
        report(growth_);
        // Stops when even 200 times the growth of the last eight blocks would not be enough.
        if (sweep % (8 * block) == 0 && sweep > 0) {
          if ((growth_ - growth_before) * 200 < 1 - growth_) return false;
          growth_before = growth_;
        }
        step_ *= static_cast<double>(accepted_) > 0.4 * static_cast<double>(tried_) ? 1.25 : 0.8;
        step_ = std::clamp(step_, 1e-4, 0.2 * skin);
        accepted_ = 0;
        tried_ = 1;
      }
      for (std::size_t m = 0; m < site_.size(); ++m) move(pick());
      for (std::size_t m = 0; m < site_.size() / 2; ++m) exchange(pick(), pick());
      growth_ = std::min(1.0, room());
    }
    return growth_ >= 1;
  }

  /// Centres in the order of the radii.
  std::vector<Point> position() const {
    std::vector<Point> result(site_.size());
    for (std::size_t i = 0; i < site_.size(); ++i) result[sphere_at_[i]] = site_[i];
    return result;
  }

private:
  static constexpr double skin = 0.4;

  std::size_t pick() { return random_.below(site_.size()); }

  void rebuild() {
    const double reach = 2 * largest_ + skin;
    const CellGrid grid(site_, container_.lengths, reach);
    near_offset_.assign(site_.size() + 1, 0);
    near_.clear();
    for (std::size_t i = 0; i < site_.size(); ++i) {
      grid.around(site_[i], [&](int j) {
        const auto b = static_cast<std::size_t>(j);
        if (b != i && point_distance(site_[i], site_[b]) < reach) near_.push_back(j);
      });
      near_offset_[i + 1] = near_.size();
    }
    listed_ = site_;
  }

  /// Whether a sphere of (inflated, full) radius r fits at p next to all neighbours of site i but `except`.
  bool fits(std::size_t i, const Point& p, double r, std::size_t except) const {
    if (!container_.holds(p, growth_ * r)) return false;
    for (std::size_t m = near_offset_[i]; m < near_offset_[i + 1]; ++m) {
      const auto j = static_cast<std::size_t>(near_[m]);
      if (j == except) continue;
      const double x = p[0] - site_[j][0], y = p[1] - site_[j][1], z = p[2] - site_[j][2];
      const double reach = growth_ * (r + radius_[sphere_at_[j]]);
      if (x * x + y * y + z * z < reach * reach) return false;
    }
    return true;
  }

  void move(std::size_t i) {
    Point p = site_[i];
    for (double& x : p) x += step_ * (2 * random_.uniform() - 1);
    ++tried_;
    // Two sites that moved by less than half the skin each cannot meet unlisted.
    if (point_distance(p, listed_[i]) > 0.5 * skin) rebuild();
    if (!fits(i, p, radius_[sphere_at_[i]], i)) return;
    ++accepted_;
    site_[i] = p;
  }

  void exchange(std::size_t i, std::size_t j) {
    const double a = radius_[sphere_at_[i]], b = radius_[sphere_at_[j]];
    if (i == j || a == b) return;
    // Apart from the pair itself, only the site that receives the larger sphere can overlap.
    const std::size_t grows = a < b ? i : j;
    if (!fits(grows, site_[grows], std::max(a, b), a < b ? j : i)) return;
    if (point_distance(site_[i], site_[j]) < growth_ * (a + b)) return;
    std::swap(sphere_at_[i], sphere_at_[j]);
  }

  /// Largest factor on the radii without overlap.
  double room() const {
    double factor = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < site_.size(); ++i) {
      const double r = radius_[sphere_at_[i]];
      factor = std::min(factor, container_.distance(site_[i]) / r);
      for (std::size_t m = near_offset_[i]; m < near_offset_[i + 1]; ++m) {
        const auto j = static_cast<std::size_t>(near_[m]);
        if (j > i) factor = std::min(factor, point_distance(site_[i], site_[j]) / (r + radius_[sphere_at_[j]]));
      }
    }
    return factor;
  }

  std::vector<Point> site_;
  std::vector<double> radius_;
  std::vector<std::size_t> sphere_at_; ///< which sphere sits at the site
  PackingContainer container_;
  Random& random_;
  std::vector<std::size_t> near_offset_;
  std::vector<int> near_;
  std::vector<Point> listed_; ///< sites when the neighbours were listed
  double largest_ = 0, growth_ = 0, step_ = 0.05;
  std::uint64_t accepted_ = 0, tried_ = 1;
};

/// Largest factor on all radii that keeps the gap at these centres.
double largest_radius_factor(const SpherePacking& packing, double gap) {
  double factor = std::numeric_limits<double>::infinity();
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  const PackingContainer container = packing.container();
  const CellGrid grid(packing.center, packing.box, 2 * largest + gap);
  for (std::size_t i = 0; i < packing.center.size(); ++i) {
    const Point& c = packing.center[i];
    factor = std::min(factor, (container.distance(c) - gap) / packing.radius[i]);
    grid.around(c, [&](int j) {
      const auto b = static_cast<std::size_t>(j);
      if (b > i)
        factor =
            std::min(factor, (point_distance(c, packing.center[b]) - gap) / (packing.radius[i] + packing.radius[b]));
    });
  }
  return std::max(factor, 0.0);
}

} // namespace

SphereGap smallest_sphere_gap(const SpherePacking& packing) {
  return smallest_gap_of_pairs(packing.center, packing.radius, -std::numeric_limits<double>::infinity());
}

SphereGap smallest_wall_gap(const SpherePacking& packing) {
  SphereGap smallest{std::numeric_limits<double>::infinity(), -1, -1};
  const PackingContainer container = packing.container();
  for (std::size_t i = 0; i < packing.center.size(); ++i)
    container.for_each_wall(packing.center[i], [&](double distance, int wall) {
      const double gap = distance - packing.radius[i];
      if (gap < smallest.gap) smallest = {gap, static_cast<int>(i), -1 - wall};
    });
  return smallest;
}

SphereGap smallest_gap(const SpherePacking& packing) {
  const SphereGap spheres = smallest_sphere_gap(packing), walls = smallest_wall_gap(packing);
  return spheres.gap < walls.gap ? spheres : walls;
}

double relative_density(const SpherePacking& packing) {
  double cubes = 0;
  for (const double r : packing.radius) cubes += r * r * r;
  return 4.0 / 3.0 * std::numbers::pi * cubes / packing.container().volume();
}

namespace {

void refuse_spheres_beyond_the_box(const PackingRequest& request) {
  const double largest = *std::max_element(request.radius.begin(), request.radius.end());
  const bool box = request.shape != ContainerShape::cylinder;
  for (std::size_t k = 0; k < 3; ++k)
    if (2 * (largest + request.smallest_gap) > request.box[k])
      throw InputError(fmt::format("the largest sphere (diameter {:g} mm) with a gap of {:g} mm to both walls does not "
                                   "fit into a {} of {:g} mm, allowed: smaller spheres or a larger container",
                                   2 * largest, request.smallest_gap,
                                   box      ? "box edge"
                                   : k == 2 ? "cylinder's height"
                                            : "cylinder's diameter",
                                   request.box[k]));
}

/// A place for a sphere, inflated to radius r: uniform in the box less r on every side; in a cylinder or surface, drawn
/// again until it is inside.
Point random_place(Random& random, const PackingContainer& container, double r) {
  constexpr int most_trials = 100000; // a surface may have far less room than its box
  Point place{}, deepest{};
  double depth = -std::numeric_limits<double>::infinity();
  for (int trial = 0;; ++trial) {
    for (std::size_t k = 0; k < 3; ++k) place[k] = r + random.uniform() * std::max(container.lengths[k] - 2 * r, 0.0);
    if (container.shape == ContainerShape::surface) {
      const double distance = container.distance(place);
      if (distance >= r) return place;
      if (distance > depth) depth = distance, deepest = place;
      if (trial == most_trials) return deepest; // a jam is reported later
    } else if (container.shape == ContainerShape::box || container.radius() <= r ||
               container.from_axis(place) <= container.radius() - r) {
      return place;
    }
  }
}

[[noreturn]] void refuse_jammed(const PackingRequest& request, const SpherePacking& packing) {
  const double factor = largest_radius_factor(packing, request.smallest_gap);
  throw InputError(
      fmt::format("{} spheres with a smallest gap of {:g} mm jam before the relative density {:.4f}; reached: "
                  "{:.4f}; lower the density, the gap, or add spheres",
                  request.radius.size(), request.smallest_gap, relative_density(packing),
                  relative_density(packing) * factor * factor * factor));
}

} // namespace

SpherePacking pack_spheres(const PackingRequest& request) {
  const std::size_t n = request.radius.size();
  refuse_spheres_beyond_the_box(request);

  // 1. Inflate the spheres, so that small overlaps still keep the gap.
  const auto [unit, inflated, inner] =
      inflated_spheres(request.radius, request.smallest_gap, {request.box, request.shape, request.surface});

  // 2. Random points.
  Random random(request.seed);
  std::vector<Point> start(n);
  for (std::size_t i = 0; i < n; ++i) start[i] = random_place(random, inner, inflated[i]);

  // 3. Minimise the overlap.
  OverlapMinimiser minimiser(std::move(start), inflated, inner);
  bool done = minimiser.minimise(allowed_overlap, 20000, [&](double overlap) {
    if (request.progress)
      request.progress(
          fmt::format("minimising the overlap, {:.2g} mean radii (wanted: {:.2g})", overlap, allowed_overlap));
  });
  std::vector<Point> best = minimiser.position();

  // 4. A jammed packing is shrunk until nothing overlaps, and grown again during random moves and exchanges.
  if (!done) {
    HardSphereCompaction compaction(std::move(best), inflated, inner, random);
    const auto moves = static_cast<double>(request.moves);
    const int sweeps = static_cast<int>(std::clamp(moves / static_cast<double>(n), 2000.0, 1e6));
    done = compaction.compact(sweeps, [&](double growth) {
      if (request.progress)
        request.progress(fmt::format("compacting, radii at {:.4f} % (wanted: 100 %)", 100 * growth));
    });
    best = compaction.position();
  }

  SpherePacking packing{request.box, std::vector<Point>(n), request.radius, request.shape, request.surface};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) packing.center[i][k] = best[i][k] * unit + 0.5 * request.smallest_gap;

  // 5. Accept only what the independent check confirms.
  if (done && smallest_gap(packing).gap >= request.smallest_gap) return packing;
  refuse_jammed(request, packing);
}

} // namespace mpfem
