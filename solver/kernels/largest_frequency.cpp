#include "solver/kernels/largest_frequency.hpp"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

#include "solver/kernels/rows.hpp"
#include "solver/physics/kinematics.hpp"

namespace mpfem {

namespace {

/// Part of the eigenvalue that its residual may be, where the iterations end: 1 % of the step.
constexpr double tolerance = 0.02;
constexpr int most_iterations = 80, iterations_between_looks = 4;

/// What single tets answer with. Viscous pressure over strain rate is density * length * (linear + quadratic * length),
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
  const double* position = model.position.data() + 4 * model.node_offset[g];
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock<Real>& block = model.block<Real>(b);
    Vector3<S> edge[3], displacement[3], force[3];
    load_edges<W, 3>(position, block.node, edge);
    load_edges<W, 3>(x, block.node, displacement);
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

} // namespace

LargestFrequency largest_frequency(const Model& model, int grain, std::span<const double> nodal_stiffness_rate,
                                   double step, double strain_rate) {
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(model.node_offset[g]);
  const std::size_t nodes = static_cast<std::size_t>(model.node_offset[g + 1]) - first;
  const Material& material = model.material_of(grain);
  const BulkViscosity& viscosity = model.viscosity;
  const LinearResponse response{material.moduli, material.density, viscosity.linear * material.wave_speed,
                                viscosity.quadratic * viscosity.quadratic * strain_rate, 2.0 / step};

  // Symmetric in z = M^(1/2) x: A = M^(-1/2) (K + 2/dt C) M^(-1/2) + D. Rows as everywhere; spare numbers stay 0.
  AlignedVector<double> previous(4 * nodes), now(4 * nodes), next(4 * nodes), x(4 * nodes), root(nodes);
  std::minstd_rand random(1); // any vector that has a part of all modes, the same each time
  double square = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    root[n] = std::sqrt(model.inverse_mass[first + n]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
      now[4 * n + axis] = value;
      square += value * value;
    }
  }
  for (double& value : now) value /= std::sqrt(square);

  std::vector<double> diagonal, beside;
  double beta = 0;
  LargestFrequency result{};
  while (true) {
    for (std::size_t n = 0; n < nodes; ++n)
      for (std::size_t c = 0; c < 4; ++c) x[4 * n + c] = root[n] * now[4 * n + c], next[4 * n + c] = 0;
    with_tet_numbers(
        model, [&](auto number) { add_product<decltype(number)>(model, grain, response, x.data(), next.data()); });
    double alpha = 0;
    for (std::size_t n = 0; n < nodes; ++n)
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t i = 4 * n + c;
        next[i] = root[n] * next[i] + nodal_stiffness_rate[first + n] * now[i] - beta * previous[i];
        alpha += next[i] * now[i];
      }
    square = 0;
    for (std::size_t i = 0; i < 4 * nodes; ++i) {
      next[i] -= alpha * now[i];
      square += next[i] * next[i];
    }
    beta = std::sqrt(square);
    diagonal.push_back(alpha);
    const auto size = static_cast<Eigen::Index>(diagonal.size());
    const bool exhausted = beta <= 1e-12 * std::abs(alpha) || size >= static_cast<Eigen::Index>(3 * nodes);
    if (size % iterations_between_looks == 0 || exhausted) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
      solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size),
                                    Eigen::Map<const Eigen::VectorXd>(beside.data(), size - 1));
      result.iterations = static_cast<int>(size);
      result.residual = exhausted ? 0.0 : beta * std::abs(solver.eigenvectors()(size - 1, size - 1));
      result.squared = solver.eigenvalues()(size - 1) + result.residual;
      if (exhausted || result.residual <= tolerance * result.squared || size >= most_iterations) return result;
    }
    beside.push_back(beta);
    for (double& value : next) value /= beta;
    previous.swap(now);
    now.swap(next);
  }
}

} // namespace mpfem
