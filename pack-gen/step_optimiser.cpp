#include "pack-gen/step_optimiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pack-gen/mesh_checks.hpp"
#include "pack-gen/random.hpp"

#include "solver/physics/elasticity.hpp"
#include "solver/physics/stable_step.hpp"

namespace mpfem {

namespace {

using Eigen::Vector3d;

/// Moduli for which the wave speed is 1 at unit density, Poisson's ratio 0.3.
ElasticModuli unit_moduli() {
  const ElasticModuli raw = elastic_moduli(1, 0.3);
  return {raw.bulk / raw.dilatational(), raw.shear / raw.dilatational()};
}

double frequency_squared(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  static const ElasticModuli moduli = unit_moduli();
  const Vector3d u = b - a, v = c - a, w = d - a;
  const auto geometry = tet_geometry<double>({u[0], u[1], u[2]}, {v[0], v[1], v[2]}, {w[0], w[1], w[2]});
  if (!(geometry.det > 0)) return std::numeric_limits<double>::infinity();
  return largest_frequency_squared(moduli, 1.0, geometry);
}

class Optimiser {
public:
  Optimiser(TetMesh& mesh, const std::vector<NodeFreedom>& freedom, double edge)
      : mesh_(mesh), freedom_(freedom), edge_(edge), position_(mesh.node.size()) {
    for (std::size_t i = 0; i < position_.size(); ++i)
      position_[i] = {mesh.node[i][0], mesh.node[i][1], mesh.node[i][2]};
    offset_.assign(position_.size() + 1, 0);
    for (const Tet& t : mesh.tet)
      for (const std::int32_t n : t) ++offset_[static_cast<std::size_t>(n) + 1];
    for (std::size_t i = 0; i < position_.size(); ++i) offset_[i + 1] += offset_[i];
    around_.resize(offset_.back());
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for (std::size_t e = 0; e < mesh.tet.size(); ++e)
      for (const std::int32_t n : mesh.tet[e]) around_[next[static_cast<std::size_t>(n)]++] = e;
    reach_.assign(position_.size(), 0.1 * edge);
  }

  void sweep(double band, Random& random) {
    std::vector<double> squared(mesh_.tet.size());
    double worst = 0;
    for (std::size_t e = 0; e < squared.size(); ++e) worst = std::max(worst, squared[e] = tet_frequency(e));
    std::vector<char> visit(position_.size(), 0);
    for (std::size_t e = 0; e < squared.size(); ++e)
      if (squared[e] * band * band >= worst)
        for (const std::int32_t n : mesh_.tet[e]) visit[static_cast<std::size_t>(n)] = 1;
    for (std::size_t i = 0; i < position_.size(); ++i)
      if (visit[i] && freedom_[i] != NodeFreedom::fixed) improve(i, random);
  }

  void store() const {
    for (std::size_t i = 0; i < position_.size(); ++i)
      mesh_.node[i] = {position_[i][0], position_[i][1], position_[i][2]};
  }

private:
  double tet_frequency(std::size_t e) const {
    const Tet& t = mesh_.tet[e];
    const auto at = [&](std::size_t k) -> const Vector3d& { return position_[static_cast<std::size_t>(t[k])]; };
    return frequency_squared(at(0), at(1), at(2), at(3));
  }

  double cost(std::size_t node) const {
    double sum = 0;
    for (std::size_t m = offset_[node]; m < offset_[node + 1]; ++m) {
      const double x = tet_frequency(around_[m]) * edge_ * edge_ * 0.05, x2 = x * x, x4 = x2 * x2;
      sum += x4 * x4;
    }
    return sum;
  }

  void improve(std::size_t node, Random& random) {
    const bool surface = freedom_[node] == NodeFreedom::on_unit_sphere;
    const Eigen::Matrix3d frame = random.rotation();
    Vector3d best = position_[node];
    double best_cost = cost(node);
    bool moved = false;
    for (int direction = 0; direction < 6; ++direction) {
      const double sign = direction % 2 == 0 ? 1 : -1;
      Vector3d trial = best + sign * reach_[node] * frame.col(direction / 2);
      if (surface) trial.normalize();
      position_[node] = trial;
      const double trial_cost = cost(node);
      if (trial_cost < best_cost) {
        best = trial;
        best_cost = trial_cost;
        moved = true;
        if (direction % 2 == 0) ++direction; // the opposite way would go back
      }
    }
    position_[node] = best;
    reach_[node] = std::clamp(reach_[node] * (moved ? 1.3 : 0.5), 1e-3 * edge_, 0.3 * edge_);
  }

  TetMesh& mesh_;
  const std::vector<NodeFreedom>& freedom_;
  double edge_;
  std::vector<Vector3d> position_;
  std::vector<std::size_t> offset_, around_;
  std::vector<double> reach_;
};

} // namespace

void raise_smallest_step(BallMesh& ball, double edge, int sweeps, double band, std::uint64_t seed) {
  std::vector<NodeFreedom> freedom(ball.mesh.node.size(), NodeFreedom::everywhere);
  std::fill_n(freedom.begin(), ball.surface_nodes, NodeFreedom::on_unit_sphere);
  raise_smallest_step(ball.mesh, freedom, edge, sweeps, band, seed);
}

void raise_smallest_step(TetMesh& mesh, const std::vector<NodeFreedom>& freedom, double edge, int sweeps, double band,
                         std::uint64_t seed) {
  Optimiser optimiser(mesh, freedom, edge);
  Random random(seed);
  for (int s = 0; s < sweeps; ++s) optimiser.sweep(band, random);
  optimiser.store();
}

double smallest_unit_step(const TetMesh& mesh) {
  double worst = 0;
  for (const Tet& t : mesh.tet) {
    Vector3d corner[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& p = mesh.node[static_cast<std::size_t>(t[k])];
      corner[k] = {p[0], p[1], p[2]};
    }
    worst = std::max(worst, frequency_squared(corner[0], corner[1], corner[2], corner[3]));
  }
  return 2 / std::sqrt(worst);
}

} // namespace mpfem
