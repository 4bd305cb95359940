#include "postproc/fits/least_squares.hpp"

#include <cmath>

#include "postproc/fits/statistics.hpp"

namespace mpfem {

namespace {

/// Half widths from the derivatives at the minimum, s^2 (J^T J)^-1. Columns are scaled first, so that parameters of
/// different size do not look dependent. Empty where the columns are linearly dependent.
std::optional<Eigen::VectorXd> half_widths(const Eigen::MatrixXd& jacobian, double squares) {
  const Eigen::VectorXd scale = jacobian.colwise().norm();
  if (!(scale.minCoeff() > 0) || !scale.allFinite()) return {};
  const Eigen::MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& singular = svd.singularValues();
  if (singular[singular.size() - 1] < 1e-9 * singular[0]) return {};
  const auto freedom = jacobian.rows() - jacobian.cols();
  if (freedom < 1) return Eigen::VectorXd::Zero(jacobian.cols());
  const double t = student_t_95(static_cast<std::size_t>(freedom));
  const Eigen::MatrixXd half = svd.matrixV() * singular.cwiseInverse().asDiagonal();
  return t * std::sqrt(squares / static_cast<double>(freedom)) * half.rowwise().norm().cwiseQuotient(scale);
}

} // namespace

std::optional<LeastSquares> linear_least_squares(const Eigen::MatrixXd& basis, const Eigen::VectorXd& y) {
  LeastSquares result;
  if (basis.rows() < basis.cols()) return {};
  result.parameters = basis.colPivHouseholderQr().solve(y);
  result.squares = (basis * result.parameters - y).squaredNorm();
  const auto half = half_widths(basis, result.squares);
  if (!half || !result.parameters.allFinite()) return {};
  result.half_width = *half;
  return result;
}

std::optional<LeastSquares> levenberg_marquardt(const ResidualFunction& function, const Eigen::VectorXd& start) {
  LeastSquares at{start, {}, 0};
  Eigen::VectorXd residual, trial_residual;
  Eigen::MatrixXd jacobian, trial_jacobian;
  if (!function(at.parameters, residual, jacobian)) return {};
  at.squares = residual.squaredNorm();
  double damping = 1e-3;
  bool at_rest = false;
  for (int step = 0; step < 200 && !at_rest; ++step) {
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::VectorXd gradient = jacobian.transpose() * residual;
    bool better = false;
    while (!better && damping < 1e12) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1 + damping;
      const Eigen::VectorXd change = damped.ldlt().solve(-gradient);
      const Eigen::VectorXd trial = at.parameters + change;
      if (change.allFinite() && function(trial, trial_residual, trial_jacobian) &&
          trial_residual.squaredNorm() <= at.squares) {
        const double squares = trial_residual.squaredNorm();
        at_rest = change.norm() <= 1e-12 * (trial.norm() + 1e-300) || squares == 0;
        at.parameters = trial;
        at.squares = squares;
        residual = trial_residual;
        jacobian = trial_jacobian;
        damping = std::max(damping / 10, 1e-15);
        better = true;
      } else {
        damping *= 10;
      }
    }
    if (!better) at_rest = true; // no step is better: the minimum to within rounding
  }
  if (!at_rest) return {};
  const auto half = half_widths(jacobian, at.squares);
  if (!half) return {};
  at.half_width = *half;
  return at;
}

} // namespace mpfem
