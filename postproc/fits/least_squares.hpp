#pragma once
// Least squares: linear, and by the Levenberg-Marquardt method.

#include <functional>
#include <optional>

#include <Eigen/Dense>

namespace mpfem {

/// Parameters that minimise a sum of squares.
struct LeastSquares {
  Eigen::VectorXd parameters;
  Eigen::VectorXd half_width; ///< of the linearised 95 % intervals (Student's t); 0 without degrees of freedom
  double squares = 0;         ///< sum of squared residuals
};

/// Minimises |basis * parameters - y|. Empty where the columns of the basis are linearly dependent, or where there are
/// fewer rows than columns.
std::optional<LeastSquares> linear_least_squares(const Eigen::MatrixXd& basis, const Eigen::VectorXd& y);

/// Fills the residuals, model minus data, and their derivatives with respect to the parameters (one row per point);
/// returns false where the model has no finite value.
using ResidualFunction =
    std::function<bool(const Eigen::VectorXd& parameters, Eigen::VectorXd& residual, Eigen::MatrixXd& jacobian)>;

/// Minimises the sum of squared residuals from a start, with Marquardt's scaling by the diagonal of J^T J. Empty where
/// it does not converge within 200 steps, or where the derivatives at the minimum are linearly dependent.
std::optional<LeastSquares> levenberg_marquardt(const ResidualFunction& function, const Eigen::VectorXd& start);

} // namespace mpfem
