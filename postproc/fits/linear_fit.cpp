#include "postproc/fits/linear_fit.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/least_squares.hpp"

namespace mpfem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void refuse_undetermined(const FitProblem& problem, const std::string& why) {
  throw InputError(fmt::format("{}: model '{}': the points do not determine its coefficients: {}",
                               one_line(problem.points.path), problem.model, why));
}

VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

Coefficient symmetric(const std::string& name, double value, double half) {
  return {name, value, value - half, value + half};
}

void set_quality(Fit& fit, const VectorXd& y, double squares) {
  const double total = (y.array() - y.mean()).square().sum();
  fit.r_squared = total > 0 ? 1 - squares / total : std::numeric_limits<double>::quiet_NaN();
  const auto freedom = y.size() - static_cast<Index>(fit.coefficients.size());
  fit.scatter = freedom > 0 ? std::sqrt(squares / static_cast<double>(freedom)) : 0;
}

Fit linear_fit(const FitProblem& problem, const MatrixXd& basis, const VectorXd& y,
               const std::vector<std::string>& names) {
  const auto solution = linear_least_squares(basis, y);
  if (!solution) refuse_undetermined(problem, "x hardly varies");
  Fit result;
  for (Index i = 0; i < basis.cols(); ++i)
    result.coefficients.push_back(
        symmetric(names[static_cast<std::size_t>(i)], solution->parameters[i], solution->half_width[i]));
  set_quality(result, y, solution->squares);
  return result;
}

MatrixXd line_basis(const VectorXd& x) {
  MatrixXd basis(x.size(), 2);
  basis << VectorXd::Ones(x.size()), x;
  return basis;
}

} // namespace mpfem
