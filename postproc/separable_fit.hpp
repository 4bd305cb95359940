#pragma once
// Fits of coefficients some of which do not enter linearly.

#include <functional>
#include <string>
#include <vector>

#include "postproc/linear_fit.hpp"

namespace mpfem {

/// y = sum over k of linear[k] * basis_k(point; nonlinear).
struct Separable {
  std::vector<std::string> linear, nonlinear; ///< names
  std::function<void(std::size_t point, const Eigen::VectorXd& nonlinear, Eigen::VectorXd& basis)>
      basis;                             ///< one value per linear
  std::vector<std::vector<double>> grid; ///< values of each nonlinear coefficient to begin from, ascending
  bool positive = false;                 ///< the nonlinear ones stay above 0
};

/// Searches the grid, the linear coefficients solved at each of its points, and refines the best by Levenberg and
/// Marquardt. Gives coefficients, linear ones first, and quality. Throws InputError where different sets fit equally
/// well, or where a positive coefficient ends beyond its grid.
Fit separable_fit(const FitProblem& problem, const Separable& model);

} // namespace mpfem
