#pragma once
// Fits in which some coefficients do not enter linearly.

#include <functional>
#include <string>
#include <vector>

#include "postproc/fits/linear_fit.hpp"

namespace mpfem {

/// A model y = sum over k of linear[k] * basis_k(point; nonlinear).
struct Separable {
  std::vector<std::string> linear, nonlinear; ///< names
  std::function<void(std::size_t point, const Eigen::VectorXd& nonlinear, Eigen::VectorXd& basis)>
      basis;                             ///< one value per linear coefficient
  std::vector<std::vector<double>> grid; ///< start values of each nonlinear coefficient, ascending
  bool positive = false;                 ///< the nonlinear ones stay above 0
};

/// Searches the grid, with the linear coefficients solved at each of its points, and refines the best points by the
/// Levenberg-Marquardt method. Sets coefficients (linear ones first) and quality. Throws InputError where different
/// sets fit equally well, or where a positive coefficient ends outside its grid.
Fit separable_fit(const FitProblem& problem, const Separable& model);

} // namespace mpfem
