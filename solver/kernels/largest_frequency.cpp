#include "solver/kernels/largest_frequency.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>

#include "solver/model/aligned.hpp"
#include "solver/model/row_pairs.hpp"
#include "solver/physics/kinematics.hpp"

namespace mpfem {

namespace {

/// Residual over eigenvalue at which the iterations end: 1 % of the step.
constexpr double tolerance = 0.02;
constexpr int most_iterations = 80, iterations_between_looks = 4;

/// The response of single tets. Viscous pressure over strain rate is density * length * (linear + quadratic * length),
/// MPa s.
struct LinearResponse {
  ElasticModuli moduli;
  double density;    ///< tonne/mm^3, in the reference state
  double linear;     ///< b1 c, mm/s
  double quadratic;  ///< b2^2 times the volumetric rate, 1/s
  double twice_rate; ///< 2/dt, 1/s
};

/// Adds (K + 2/dt C) x to `product`, both rows of a grain's nodes (mm, N).
template <class Real>
MPFEM_FLATTEN void add_product(const Model& model, int grain, const LinearResponse& response, const double* x,
                               double* product) {
  constexpr int W = TetBlock<Real>::lanes;
  using S = Pack<W, Real>;
  const auto g = static_cast<std::size_t>(grain);
  thread_local RowPairs<Real> both;
  const Real* pairs = both.place(model.position.data() + model.first_row(grain), x, 1.0,
                                 model.end_node(grain) - model.first_node(grain));
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock<Real>& block = model.block<Real>(b);
    Vector3<S> edge[3], displacement[3], force[3];
    load_edge_pairs<W, 3>(pairs, block.node, edge, displacement);
    const TetGeometry<S> geometry = tet_geometry(edge[0], edge[1], edge[2]);
    const SymmetricTensor<S> strain = displacement_increment(geometry, displacement).strain;
    const S volumetric = strain.xx + strain.yy + strain.zz;
    const S density = S(6.0 * response.density) / (geometry.det * S::load(block.inverse_volume));
    const S length = S::load(block.length);
    const S viscous = S(response.twice_rate) * density * length * (S(response.linear) + S(response.quadratic) * length);
    const S mean = (S(response.moduli.bulk) + viscous) * volumetric;
    const Deviator<S> zero{S(0.0), S(0.0), S(0.0), S(0.0), S(0.0)};
    const Deviator<S> deviator = elastic_predictor(response.moduli, zero, strain);
    S sixth(1.0 / 6.0);
    for (int lane = model.tets_in_block<Real>(grain, b); lane < W; ++lane)
      sixth.v[lane] = 0; // nothing from unused lanes
    for (int i = 0; i < 3; ++i) force[i] = sixth * traction(deviator, mean, geometry.area[i]);
    add_balanced<W>(product, block.node, force);
  }
}

/// A vector of length 1 with a part in every mode, the same each time; rows of a grain's nodes, spare numbers 0.
AlignedVector<double> start_vector(std::size_t nodes) {
  AlignedVector<double> vector(4 * nodes);
  std::minstd_rand random(1);
  double square = 0;
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
      vector[4 * n + axis] = value;
      square += value * value;
    }
  for (double& value : vector) value /= std::sqrt(square);
  return vector;
}

/// Largest eigenvalue of a symmetric tridiagonal matrix, and the last component of its eigenvector.
struct LargestEigenvalue {
  double value, last_component;
};
LargestEigenvalue largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto size = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), size - 1));
  return {solver.eigenvalues()(size - 1), solver.eigenvectors()(size - 1, size - 1)};
}

/// Lanczos iterations on one grain. Symmetric in z = M^(1/2) x: A = M^(-1/2) (K + 2/dt C) M^(-1/2) + D. Rows as
/// everywhere; spare numbers stay 0.
class LanczosIteration {
public:
  LanczosIteration(const Model& model, int grain, const LinearResponse& response, std::span<const double> contact)
      : model_(model), grain_(grain), response_(response), contact_(contact), first_(model.first_node(grain)),
        nodes_(model.end_node(grain) - first_), previous_(4 * nodes_), now_(start_vector(nodes_)), next_(4 * nodes_),
        x_(4 * nodes_), root_(nodes_) {
    for (std::size_t n = 0; n < nodes_; ++n) root_[n] = std::sqrt(model.inverse_mass[first_ + n]);
  }

  /// One more row and column of the tridiagonal matrix.
  void advance() {
    if (!diagonal_.empty()) {
      beside_.push_back(beta_);
      for (double& value : next_) value /= beta_;
      previous_.swap(now_);
      now_.swap(next_);
    }
    multiply();
    double alpha = 0;
    for (std::size_t n = 0; n < nodes_; ++n)
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t i = 4 * n + c;
        next_[i] = root_[n] * next_[i] + contact_[first_ + n] * now_[i] - beta_ * previous_[i];
        alpha += next_[i] * now_[i];
      }
    double square = 0;
    for (std::size_t i = 0; i < 4 * nodes_; ++i) {
      next_[i] -= alpha * now_[i];
      square += next_[i] * next_[i];
    }
    beta_ = std::sqrt(square);
    diagonal_.push_back(alpha);
  }

  int iterations() const { return static_cast<int>(diagonal_.size()); }
  /// Whether all modes in which the start vector has a part are found.
  bool exhausted() const { return beta_ <= 1e-12 * std::abs(diagonal_.back()) || diagonal_.size() >= 3 * nodes_; }
  LargestFrequency result() const {
    const LargestEigenvalue largest = largest_eigenvalue(diagonal_, beside_);
    LargestFrequency result{};
    result.iterations = iterations();
    result.residual = exhausted() ? 0.0 : beta_ * std::abs(largest.last_component);
    result.squared = largest.value + result.residual;
    return result;
  }

private:
  /// next = (K + 2/dt C) M^(-1/2) now
  void multiply() {
    for (std::size_t n = 0; n < nodes_; ++n)
      for (std::size_t c = 0; c < 4; ++c) x_[4 * n + c] = root_[n] * now_[4 * n + c], next_[4 * n + c] = 0;
    with_tet_numbers(model_, [&](auto number) {
      add_product<decltype(number)>(model_, grain_, response_, x_.data(), next_.data());
    });
  }

  const Model& model_;
  int grain_;
  LinearResponse response_;
  std::span<const double> contact_; ///< D, 1/s^2, [nodes of the model]
  std::size_t first_, nodes_;
  AlignedVector<double> previous_, now_, next_, x_, root_;
  std::vector<double> diagonal_, beside_;
  double beta_ = 0;
};

} // namespace

LargestFrequency largest_frequency(const Model& model, int grain, std::span<const double> nodal_stiffness_rate,
                                   double step, double strain_rate) {
  const Material& material = model.material_of(grain);
  const BulkViscosity& viscosity = model.viscosity;
  const LinearResponse response{material.moduli, material.density, viscosity.linear * material.wave_speed,
                                viscosity.quadratic * viscosity.quadratic * strain_rate, 2.0 / step};
  LanczosIteration lanczos(model, grain, response, nodal_stiffness_rate);
  while (true) {
    lanczos.advance();
    const bool exhausted = lanczos.exhausted();
    if (lanczos.iterations() % iterations_between_looks != 0 && !exhausted) continue;
    const LargestFrequency found = lanczos.result();
    if (exhausted || found.residual <= tolerance * found.squared || found.iterations >= most_iterations) return found;
  }
}

} // namespace mpfem
