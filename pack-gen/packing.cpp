#include "pack-gen/packing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "pack-gen/neighbours.hpp"
#include "pack-gen/random.hpp"
#include "pack-gen/sphere_tree.hpp"

namespace mpfem {

namespace {

double distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

/// Soft inflated spheres whose overlap energy is minimised. Lengths in mean inflated radii, stiffness and mass 1.
class OverlapMinimiser {
public:
  OverlapMinimiser(std::vector<Point> position, std::vector<double> radius, const Point& box)
      : position_(std::move(position)), radius_(std::move(radius)), box_(box), velocity_(position_.size(), Point{}),
        force_(position_.size(), Point{}) {
    largest_ = *std::max_element(radius_.begin(), radius_.end());
    rebuild();
    evaluate();
  }

  /// Minimises until no overlap exceeds `allowed` (true) or forces balance or `steps` are used (false). `report` is
  /// called with the largest overlap now and then.
  template <class Report>
  bool minimise(double allowed, int steps, Report report) {
    for (Point& v : velocity_) v = {};
    Fire fire;
    double energy_before = energy_;
    for (int step = 0; step < steps; ++step) {
      if (largest_overlap_ <= allowed) return true;
      if (step % 100 == 0) {
        report(largest_overlap_);
        // Jammed when what is left of the forces no longer moves anything.
        if (step > 0 && energy_ > 0.9995 * energy_before && fire.downhill > 20 && residual_ < 1e-3 * pressure_)
          return false;
        energy_before = energy_;
      }
      move(fire.next(products(), step == 0));
      if (2 * travel_ > skin) rebuild();
      evaluate();
    }
    return largest_overlap_ <= allowed;
  }

  void place(std::vector<Point> position) {
    position_ = std::move(position);
    rebuild();
    evaluate();
  }
  const std::vector<Point>& position() const { return position_; }
  double energy() const { return energy_; }
  double largest_overlap() const { return largest_overlap_; }

private:
  static constexpr double skin = 0.5;

  /// Sums over all components of velocities and forces.
  struct Products {
    double power = 0, speed2 = 0, force2 = 0;
  };

  /// What a step does to the velocities: kept, turned along the forces, driven by them.
  struct Step {
    double keep, along, dt;
  };

  /// FIRE with the parameters of the reference; the step's upper bound keeps a pair from jumping over each other.
  struct Fire {
    double dt = 0.1, mixing = 0.1;
    int downhill = 0; ///< steps since the energy last rose

    Step next(const Products& now, bool first) {
      if (now.power > 0) {
        if (++downhill > 5) {
          dt = std::min(dt * 1.1, 0.7);
          mixing *= 0.99;
        }
      } else if (!first) {
        downhill = 0;
        dt *= 0.5;
        mixing = 0.1;
      }
      const double along = now.power > 0 && now.force2 > 0 ? mixing * std::sqrt(now.speed2 / now.force2) : 0;
      return {now.power > 0 ? 1 - mixing : 0, along, dt};
    }
  };

  Products products() const {
    Products sum;
    for (std::size_t i = 0; i < position_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        sum.power += force_[i][k] * velocity_[i][k];
        sum.speed2 += velocity_[i][k] * velocity_[i][k];
        sum.force2 += force_[i][k] * force_[i][k];
      }
    return sum;
  }

  /// Changes velocities and then positions; the fastest sphere moves no further than 0.2.
  void move(const Step& step) {
    double fastest2 = 0;
    for (std::size_t i = 0; i < position_.size(); ++i) {
      double v2 = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        velocity_[i][k] = step.keep * velocity_[i][k] + step.along * force_[i][k] + step.dt * force_[i][k];
        v2 += velocity_[i][k] * velocity_[i][k];
      }
      fastest2 = std::max(fastest2, v2);
    }
    const double time = std::min(step.dt, 0.2 / std::sqrt(fastest2 + 1e-300));
    for (std::size_t i = 0; i < position_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) position_[i][k] += time * velocity_[i][k];
    travel_ += time * std::sqrt(fastest2);
  }

  void rebuild() {
    const CellGrid grid(position_, box_, 2 * largest_ + skin);
    pair_.clear();
    // Pairs in the order of the cells keep neighbours close in memory.
    for (const int i : grid.member) {
      const auto a = static_cast<std::size_t>(i);
      grid.around(position_[a], [&](int j) {
        const auto b = static_cast<std::size_t>(j);
        if (j > i && distance(position_[a], position_[b]) < radius_[a] + radius_[b] + skin) pair_.push_back({i, j});
      });
    }
    travel_ = 0;
  }

  void evaluate() {
    for (Point& f : force_) f = {};
    energy_ = largest_overlap_ = pressure_ = 0;
    for (const auto& [i, j] : pair_) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double x = position_[a][0] - position_[b][0], y = position_[a][1] - position_[b][1],
                   z = position_[a][2] - position_[b][2];
      const double reach = radius_[a] + radius_[b], d2 = x * x + y * y + z * z;
      if (d2 >= reach * reach) continue;
      const double d = std::sqrt(d2), overlap = reach - d, scale = d > 0 ? overlap / d : 0;
      energy_ += 0.5 * overlap * overlap;
      pressure_ += overlap;
      largest_overlap_ = std::max(largest_overlap_, overlap);
      force_[a][0] += scale * x, force_[a][1] += scale * y, force_[a][2] += scale * z;
      force_[b][0] -= scale * x, force_[b][1] -= scale * y, force_[b][2] -= scale * z;
    }
    residual_ = 0;
    for (std::size_t i = 0; i < position_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double low = radius_[i] - position_[i][k], high = position_[i][k] + radius_[i] - box_[k];
        for (const auto& [overlap, sign] : {std::pair{low, 1.0}, std::pair{high, -1.0}}) {
          if (overlap <= 0) continue;
          energy_ += 0.5 * overlap * overlap;
          pressure_ += overlap;
          largest_overlap_ = std::max(largest_overlap_, overlap);
          force_[i][k] += sign * overlap;
        }
        residual_ += std::abs(force_[i][k]);
      }
  }

  std::vector<Point> position_;
  std::vector<double> radius_;
  Point box_;
  std::vector<Point> velocity_, force_;
  std::vector<std::pair<int, int>> pair_;
  double largest_ = 0, travel_ = 0, energy_ = 0, largest_overlap_ = 0;
  double pressure_ = 0; ///< sum of overlaps
  double residual_ = 0; ///< sum of the components of what force is unbalanced
};

/// Hard inflated spheres that move at random and grow whenever there is room (Monte Carlo compaction). Exchanging two
/// spheres of different size lets the packing forget its arrangement far beyond where moves alone arrest (swap Monte
/// Carlo, Grigera & Parisi, Phys. Rev. E 63, 045102, 2001). Lengths as in OverlapMinimiser.
class HardSphereCompaction {
public:
  HardSphereCompaction(std::vector<Point> position, std::vector<double> radius, const Point& box, Random& random)
      : site_(std::move(position)), radius_(std::move(radius)), sphere_at_(site_.size()), box_(box), random_(random) {
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
        // Stops when even a thousand times the growth of the last blocks would not be enough.
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
    const CellGrid grid(site_, box_, reach);
    near_offset_.assign(site_.size() + 1, 0);
    near_.clear();
    for (std::size_t i = 0; i < site_.size(); ++i) {
      grid.around(site_[i], [&](int j) {
        const auto b = static_cast<std::size_t>(j);
        if (b != i && distance(site_[i], site_[b]) < reach) near_.push_back(j);
      });
      near_offset_[i + 1] = near_.size();
    }
    listed_ = site_;
  }

  /// Whether a sphere of (inflated, full) radius r fits at p beside all neighbours of site i but `except`.
  bool fits(std::size_t i, const Point& p, double r, std::size_t except) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < growth_ * r || p[k] > box_[k] - growth_ * r) return false;
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
    if (distance(p, listed_[i]) > 0.5 * skin) rebuild();
    if (!fits(i, p, radius_[sphere_at_[i]], i)) return;
    ++accepted_;
    site_[i] = p;
  }

  void exchange(std::size_t i, std::size_t j) {
    const double a = radius_[sphere_at_[i]], b = radius_[sphere_at_[j]];
    if (i == j || a == b) return;
    // Only the site that receives the larger sphere can come to overlap, but for the pair itself.
    const std::size_t grows = a < b ? i : j;
    if (!fits(grows, site_[grows], std::max(a, b), a < b ? j : i)) return;
    if (distance(site_[i], site_[j]) < growth_ * (a + b)) return;
    std::swap(sphere_at_[i], sphere_at_[j]);
  }

  /// Largest factor on the radii without overlap.
  double room() const {
    double factor = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < site_.size(); ++i) {
      const double r = radius_[sphere_at_[i]];
      for (std::size_t k = 0; k < 3; ++k) factor = std::min({factor, site_[i][k] / r, (box_[k] - site_[i][k]) / r});
      for (std::size_t m = near_offset_[i]; m < near_offset_[i + 1]; ++m) {
        const auto j = static_cast<std::size_t>(near_[m]);
        if (j > i) factor = std::min(factor, distance(site_[i], site_[j]) / (r + radius_[sphere_at_[j]]));
      }
    }
    return factor;
  }

  std::vector<Point> site_;
  std::vector<double> radius_;
  std::vector<std::size_t> sphere_at_; ///< which sphere sits at the site
  Point box_;
  Random& random_;
  std::vector<std::size_t> near_offset_;
  std::vector<int> near_;
  std::vector<Point> listed_; ///< sites when the neighbours were listed
  double largest_ = 0, growth_ = 0, step_ = 0.05;
  std::uint64_t accepted_ = 0, tried_ = 1;
};

/// Largest factor on all radii for which the gap is kept at these centres.
double largest_radius_factor(const SpherePacking& packing, double gap) {
  double factor = std::numeric_limits<double>::infinity();
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  const CellGrid grid(packing.center, packing.box, 2 * largest + gap);
  for (std::size_t i = 0; i < packing.center.size(); ++i) {
    const Point& c = packing.center[i];
    for (std::size_t k = 0; k < 3; ++k)
      factor = std::min(factor, (std::min(c[k], packing.box[k] - c[k]) - gap) / packing.radius[i]);
    grid.around(c, [&](int j) {
      const auto b = static_cast<std::size_t>(j);
      if (b > i)
        factor = std::min(factor, (distance(c, packing.center[b]) - gap) / (packing.radius[i] + packing.radius[b]));
    });
  }
  return std::max(factor, 0.0);
}

} // namespace

SurfaceGap smallest_sphere_gap(const SpherePacking& packing) {
  return smallest_gap_of_pairs(packing.center, packing.radius, -std::numeric_limits<double>::infinity());
}

SurfaceGap smallest_wall_gap(const SpherePacking& packing) {
  SurfaceGap smallest{std::numeric_limits<double>::infinity(), -1, -1};
  for (std::size_t i = 0; i < packing.center.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = packing.center[i][k] - packing.radius[i];
      const double high = packing.box[k] - packing.center[i][k] - packing.radius[i];
      if (low < smallest.gap) smallest = {low, static_cast<int>(i), -1 - static_cast<int>(2 * k)};
      if (high < smallest.gap) smallest = {high, static_cast<int>(i), -2 - static_cast<int>(2 * k)};
    }
  return smallest;
}

SurfaceGap smallest_gap(const SpherePacking& packing) {
  const SurfaceGap spheres = smallest_sphere_gap(packing), walls = smallest_wall_gap(packing);
  return spheres.gap < walls.gap ? spheres : walls;
}

double relative_density(const SpherePacking& packing) {
  double cubes = 0;
  for (const double r : packing.radius) cubes += r * r * r;
  return 4.0 / 3.0 * std::numbers::pi * cubes / (packing.box[0] * packing.box[1] * packing.box[2]);
}

namespace {

void refuse_spheres_beyond_the_box(const PackingRequest& request) {
  const double largest = *std::max_element(request.radius.begin(), request.radius.end());
  for (const double edge : request.box)
    if (2 * (largest + request.smallest_gap) > edge)
      throw InputError(
          fmt::format("the largest sphere (diameter {:g} mm) with a gap of {:g} mm to both walls does not fit "
                      "into a box edge of {:g} mm",
                      2 * largest, request.smallest_gap, edge));
}

[[noreturn]] void refuse_jammed(const PackingRequest& request, const SpherePacking& packing) {
  const double factor = largest_radius_factor(packing, request.smallest_gap);
  throw InputError(
      fmt::format("{} spheres with a smallest gap of {:g} mm jam before the relative density {:.4f}; reached: "
                  "{:.3f}; lower the density, the gap, or add spheres",
                  request.radius.size(), request.smallest_gap, relative_density(packing),
                  relative_density(packing) * factor * factor * factor));
}

} // namespace

SpherePacking pack_spheres(const PackingRequest& request) {
  const std::size_t n = request.radius.size();
  double mean = 0;
  for (const double r : request.radius) mean += r / static_cast<double>(n);
  refuse_spheres_beyond_the_box(request);

  // 1. Inflate by half the gap and a margin: overlaps up to the margin then still keep the gap. The walls move inwards
  //    by half the gap, which together with the inflation leaves the whole gap to them.
  const double unit = mean + 0.5 * request.smallest_gap, margin = 2e-4;
  std::vector<double> inflated(n);
  for (std::size_t i = 0; i < n; ++i) inflated[i] = (request.radius[i] + 0.5 * request.smallest_gap) / unit + margin;
  Point inner;
  for (std::size_t k = 0; k < 3; ++k) inner[k] = (request.box[k] - request.smallest_gap) / unit;

  // 2. Random points.
  Random random(request.seed);
  std::vector<Point> start(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      start[i][k] = inflated[i] + random.uniform() * std::max(inner[k] - 2 * inflated[i], 0.0);

  // 3. Minimise the overlap.
  OverlapMinimiser minimiser(std::move(start), inflated, inner);
  const double allowed = 0.9 * margin;
  bool done = minimiser.minimise(allowed, 20000, [&](double overlap) {
    if (request.progress) request.progress(fmt::format("minimising the overlap, {:.2g} left", overlap));
  });
  std::vector<Point> best = minimiser.position();

  // 4. What jams is shrunk until nothing overlaps, and grown again among random moves and exchanges.
  if (!done) {
    HardSphereCompaction compaction(std::move(best), inflated, inner, random);
    const auto moves = static_cast<double>(request.moves);
    const int sweeps = static_cast<int>(std::clamp(moves / static_cast<double>(n), 2000.0, 1e6));
    done = compaction.compact(sweeps, [&](double growth) {
      if (request.progress) request.progress(fmt::format("compacting, radii at {:.2f} %", 100 * growth));
    });
    best = compaction.position();
  }

  SpherePacking packing{request.box, std::vector<Point>(n), request.radius};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) packing.center[i][k] = best[i][k] * unit + 0.5 * request.smallest_gap;

  // 5. Accept only what the independent check confirms.
  if (done && smallest_gap(packing).gap >= request.smallest_gap) return packing;
  refuse_jammed(request, packing);
}

} // namespace mpfem
