#pragma once
// Fits of coefficients that enter linearly, and what all fits share.

#include <string>
#include <vector>

#include <Eigen/Dense>

#include "postproc/fits/fit.hpp"

namespace mpfem {

/// What a model is fitted to.
struct FitProblem {
  std::string model; ///< for messages
  FitPoints points;  ///< x as the model needs it: the porosity for models of porosity
};

/// Throws InputError: the points do not determine the model's coefficients.
[[noreturn]] void refuse_undetermined(const FitProblem& problem, const std::string& why);

/// The values as a vector of Eigen.
Eigen::VectorXd as_vector(const std::vector<double>& values);

/// A coefficient with the interval value ± half.
Coefficient symmetric(const std::string& name, double value, double half);

/// Sets r_squared and scatter of a fit that has its coefficients; `y`: what was fitted, `squares`: sum of the squared
/// residuals.
void set_quality(Fit& fit, const Eigen::VectorXd& y, double squares);

/// Fits y = basis * coefficients, with one name per column of the basis. Sets coefficients and quality. Throws
/// InputError where the points do not determine the coefficients.
Fit linear_fit(const FitProblem& problem, const Eigen::MatrixXd& basis, const Eigen::VectorXd& y,
               const std::vector<std::string>& names);

/// The columns 1 and x.
Eigen::MatrixXd line_basis(const Eigen::VectorXd& x);

} // namespace mpfem
