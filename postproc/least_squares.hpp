#pragma once
// Least squares: linear, and by Levenberg and Marquardt's method.

#include <functional>
#include <optional>

#include <Eigen/Dense>

namespace mpfem {

struct LeastSquares {
  Eigen::VectorXd parameters;
  Eigen::VectorXd half_width; ///< of the linearised 95 % intervals (Student's t); 0 without degrees of freedom
  double squares = 0;         ///< sum of squared residuals
};

/// Minimises |basis * parameters - y|. Nothing where the columns of the basis are linearly dependent.
std::optional<LeastSquares> linear_least_squares(const Eigen::MatrixXd& basis, const Eigen::VectorXd& y);

/// Fills the residuals, model less data, and their derivatives by the parameters, a row a point; false where the model
/// has no finite value.
using ResidualFunction =
    std::function<bool(const Eigen::VectorXd& parameters, Eigen::VectorXd& residual, Eigen::MatrixXd& jacobian)>;

/// Minimises the residuals from a start, with Marquardt's scaling by the diagonal of J^T J. Nothing where it does not
/// come to rest within 200 steps, or where the derivatives at the minimum are linearly dependent.
std::optional<LeastSquares> levenberg_marquardt(const ResidualFunction& function, const Eigen::VectorXd& start);

} // namespace mpfem
