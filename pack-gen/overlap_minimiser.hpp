#pragma once
// Soft spheres between walls that repel each other where they overlap, and come to rest where their energy is least.

#include <algorithm>
#include <cmath>
#include <vector>

#include "pack-gen/container.hpp"
#include "pack-gen/neighbours.hpp"

namespace mpfem {

/// Distance of two points, in their own unit.
inline double point_distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

/// Soft inflated spheres whose overlap energy is minimised. Lengths in mean inflated radii, stiffness and mass 1.
class OverlapMinimiser {
public:
  OverlapMinimiser(std::vector<Point> position, std::vector<double> radius, const PackingContainer& container)
      : position_(std::move(position)), radius_(std::move(radius)), container_(container),
        velocity_(position_.size(), Point{}), force_(position_.size(), Point{}) {
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
        // Jammed when the remaining forces no longer move anything.
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

  /// Gives the spheres a weight, downwards along z: this much for a radius of 1, in proportion to volume for others.
  void set_weight(double weight) {
    weight_ = weight;
    evaluate();
  }

  /// Lets the spheres sink until each carries its weight, up to this share of it (true), or `steps` are used (false).
  template <class Report>
  bool sink(double share, int steps, Report report) {
    for (Point& v : velocity_) v = {};
    // Below 2 over the largest frequency of a sphere held by twelve others: above that, rest is never quite reached.
    Fire fire{.largest_dt = 0.3};
    for (int step = 0; step < steps; ++step) {
      if (step % 100 == 0) report(unbalanced_share());
      if (unbalanced_share() <= share) return true;
      move(fire.next(products(), step == 0));
      if (2 * travel_ > skin) rebuild();
      evaluate();
    }
    return unbalanced_share() <= share;
  }

  /// Largest force that is left on a sphere, over its weight.
  double unbalanced_share() const {
    double largest = 0;
    for (std::size_t i = 0; i < position_.size(); ++i)
      largest = std::max(largest, std::hypot(force_[i][0], force_[i][1], force_[i][2]) / weight_of(i));
    return largest;
  }

  const std::vector<Point>& position() const { return position_; }
  double largest_overlap() const { return largest_overlap_; }

private:
  static constexpr double skin = 0.5;

  double weight_of(std::size_t i) const { return weight_ * radius_[i] * radius_[i] * radius_[i]; }

  /// Sums over all components of velocities and forces.
  struct Products {
    double power = 0, speed2 = 0, force2 = 0;
  };

  /// What a step does to the velocities: keeps part, turns part along the forces, accelerates.
  struct Step {
    double keep, along, dt;
  };

  /// FIRE with the parameters of the reference; the step's upper bound keeps a pair from jumping over each other.
  struct Fire {
    double largest_dt = 0.7;
    double dt = 0.1, mixing = 0.1;
    int downhill = 0; ///< steps since the energy last rose

    Step next(const Products& now, bool first) {
      if (now.power > 0) {
        if (++downhill > 5) {
          dt = std::min(dt * 1.1, largest_dt);
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
    const CellGrid grid(position_, container_.lengths, 2 * largest_ + skin);
    pair_.clear();
    // Pairs in the order of the cells keep neighbours close in memory.
    for (const int i : grid.member) {
      const auto a = static_cast<std::size_t>(i);
      grid.around(position_[a], [&](int j) {
        const auto b = static_cast<std::size_t>(j);
        if (j > i && point_distance(position_[a], position_[b]) < radius_[a] + radius_[b] + skin)
          pair_.push_back({i, j});
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
    for (std::size_t i = 0; i < position_.size(); ++i) {
      container_.for_each_overlap(position_[i], radius_[i], [&](double overlap, const Point& inward) {
        if (overlap <= 0) return;
        energy_ += 0.5 * overlap * overlap;
        pressure_ += overlap;
        largest_overlap_ = std::max(largest_overlap_, overlap);
        for (std::size_t k = 0; k < 3; ++k) force_[i][k] += overlap * inward[k];
      });
      if (weight_ > 0) {
        force_[i][2] -= weight_of(i);
        energy_ += weight_of(i) * position_[i][2];
      }
      for (const double component : force_[i]) residual_ += std::abs(component);
    }
  }

  std::vector<Point> position_;
  std::vector<double> radius_;
  PackingContainer container_;
  std::vector<Point> velocity_, force_;
  std::vector<std::pair<int, int>> pair_;
  double weight_ = 0; ///< of a sphere of radius 1
  double largest_ = 0, travel_ = 0, energy_ = 0, largest_overlap_ = 0;
  double pressure_ = 0; ///< sum of overlaps
  double residual_ = 0; ///< sum of the components of unbalanced forces
};

} // namespace mpfem
