#pragma once
// A fit of coefficients that enter linearly, and what all fits share.

#include <string>
#include <vector>

#include <Eigen/Dense>

#include "postproc/fit.hpp"

namespace mpfem {

/// What a model is fitted to.
struct FitProblem {
  std::string model; ///< for messages
  FitPoints points;  ///< x as the model takes it: the porosity where it does
};

/// Throws InputError: the points do not determine the model's coefficients.
[[noreturn]] void undetermined(const FitProblem& problem, const std::string& why);

Eigen::VectorXd as_vector(const std::vector<double>& values);

/// A coefficient with the interval value ± half.
Coefficient symmetric(const std::string& name, double value, double half);

/// r_squared and scatter of a fit that has its coefficients; `y`: what was fitted, `squares`: of its residuals.
void set_quality(Fit& fit, const Eigen::VectorXd& y, double squares);

/// y = basis * coefficients, a column of the basis and a name for each. Gives coefficients and quality.
Fit linear_fit(const FitProblem& problem, const Eigen::MatrixXd& basis, const Eigen::VectorXd& y,
               const std::vector<std::string>& names);

/// The columns 1 and x.
Eigen::MatrixXd line_basis(const Eigen::VectorXd& x);

} // namespace mpfem
