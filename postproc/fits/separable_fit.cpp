#include "postproc/fits/separable_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/fits/least_squares.hpp"

namespace mpfem {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd basis_of(const Separable& model, std::size_t points, const VectorXd& nonlinear) {
  MatrixXd basis(static_cast<Index>(points), static_cast<Index>(model.linear.size()));
  VectorXd row(static_cast<Index>(model.linear.size()));
  for (std::size_t i = 0; i < points; ++i) {
    model.basis(i, nonlinear, row);
    basis.row(static_cast<Index>(i)) = row;
  }
  return basis;
}

ResidualFunction residuals_of(const Separable& model, const VectorXd& y) {
  return [&model, &y](const VectorXd& parameters, VectorXd& residual, MatrixXd& jacobian) {
    const auto points = static_cast<std::size_t>(y.size());
    const auto linear = static_cast<Index>(model.linear.size()), nonlinear = static_cast<Index>(model.nonlinear.size());
    const VectorXd a = parameters.head(linear), b = parameters.tail(nonlinear);
    if (model.positive && !(b.minCoeff() > 0)) return false;
    jacobian.resize(y.size(), linear + nonlinear);
    jacobian.leftCols(linear) = basis_of(model, points, b);
    residual = jacobian.leftCols(linear) * a - y;
    for (Index k = 0; k < nonlinear; ++k) { // central differences: relative error of the order 1e-10
      const double step = 1e-5 * std::max(std::abs(b[k]), 1e-8);
      VectorXd above = b, below = b;
      above[k] += step;
      below[k] -= step;
      jacobian.col(linear + k) = (basis_of(model, points, above) - basis_of(model, points, below)) * a / (2 * step);
    }
    return residual.allFinite() && jacobian.allFinite();
  };
}

/// Every combination of the grid's values; the first coefficient varies fastest.
std::vector<VectorXd> grid_points(const std::vector<std::vector<double>>& grid) {
  std::vector<VectorXd> points;
  std::vector<std::size_t> index(grid.size(), 0);
  for (bool more = true; more;) {
    VectorXd& point = points.emplace_back(static_cast<Index>(grid.size()));
    for (std::size_t d = 0; d < grid.size(); ++d) point[static_cast<Index>(d)] = grid[d][index[d]];
    std::size_t d = 0;
    while (d < grid.size() && ++index[d] == grid[d].size()) index[d++] = 0;
    more = d < grid.size();
  }
  return points;
}

struct Start {
  double squares;
  VectorXd parameters;
};

/// The grid's points with the linear coefficients solved, best first.
std::vector<Start> starts_on_grid(const Separable& model, const VectorXd& y) {
  std::vector<Start> starts;
  for (const VectorXd& nonlinear : grid_points(model.grid)) {
    const MatrixXd basis = basis_of(model, static_cast<std::size_t>(y.size()), nonlinear);
    if (!basis.allFinite()) continue;
    const auto solution = linear_least_squares(basis, y);
    if (!solution) continue;
    VectorXd parameters(solution->parameters.size() + nonlinear.size());
    parameters << solution->parameters, nonlinear;
    starts.push_back({solution->squares, parameters});
  }
  std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.squares < b.squares; });
  return starts;
}

std::optional<LeastSquares> best_refined(const std::vector<Start>& starts, const Separable& model, const VectorXd& y) {
  constexpr std::size_t starts_refined = 8;
  std::optional<LeastSquares> best;
  for (std::size_t i = 0; i < std::min(starts.size(), starts_refined); ++i) {
    const auto solution = levenberg_marquardt(residuals_of(model, y), starts[i].parameters);
    if (solution && (!best || solution->squares < best->squares)) best = solution;
  }
  return best;
}

/// Throws InputError where a coefficient lies outside its grid.
void need_saturation(const FitProblem& problem, const std::string& name, double value,
                     const std::vector<double>& grid) {
  if (value < grid.front() || value > grid.back())
    refuse_undetermined(problem,
                        fmt::format("{} = {:.3g} lies beyond {:.3g} … {:.3g}, so the points show no saturation", name,
                                    value, grid.front(), grid.back()));
}

} // namespace

Fit separable_fit(const FitProblem& problem, const Separable& model) {
  const VectorXd y = as_vector(problem.points.y);
  const auto best = best_refined(starts_on_grid(model, y), model, y);
  if (!best) refuse_undetermined(problem, "different sets fit equally well");
  std::vector<std::string> names = model.linear;
  names.insert(names.end(), model.nonlinear.begin(), model.nonlinear.end());
  Fit result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto index = static_cast<Index>(i);
    result.coefficients.push_back(symmetric(names[i], best->parameters[index], best->half_width[index]));
    if (i >= model.linear.size() && model.positive)
      need_saturation(problem, names[i], best->parameters[index], model.grid[i - model.linear.size()]);
  }
  set_quality(result, y, best->squares);
  return result;
}

} // namespace mpfem
