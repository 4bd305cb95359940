#include "postproc/fits/bilinear_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "postproc/fits/least_squares.hpp"
#include "postproc/fits/statistics.hpp"

namespace mpfem {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kinks = 4000;

/// Where a kink may lie: two points or more on either side, otherwise one of the lines is undetermined.
struct KinkRange {
  double low, high;
  double step() const { return (high - low) / kinks; }
  double at(int i) const { return low + (high - low) * i / kinks; }
};

KinkRange range_of_kinks(const std::vector<double>& x) {
  const std::set<double> sorted(x.begin(), x.end());
  return {*std::next(sorted.begin()), *std::prev(sorted.end(), 2)};
}

/// The coefficients y_kink, slope_below, slope_above.
std::optional<LeastSquares> lines_through(const VectorXd& x, const VectorXd& y, double kink) {
  MatrixXd basis(x.size(), 3);
  basis.col(0).setOnes();
  basis.col(1) = (x.array() - kink).cwiseMin(0);
  basis.col(2) = (x.array() - kink).cwiseMax(0);
  return linear_least_squares(basis, y);
}

/// Sum of squared residuals of the best lines for every kink.
std::vector<double> profile_of_squares(const VectorXd& x, const VectorXd& y, const KinkRange& range) {
  std::vector<double> squares;
  for (int i = 0; i <= kinks; ++i) {
    const auto solution = lines_through(x, y, range.at(i));
    squares.push_back(solution ? solution->squares : std::numeric_limits<double>::infinity());
  }
  return squares;
}

/// First and last kink whose sum of squares is within the limit, `best` included.
std::pair<int, int> kinks_within(const std::vector<double>& squares, double limit, int best) {
  int from = best, to = best;
  for (int i = 0; i <= kinks; ++i)
    if (squares[static_cast<std::size_t>(i)] <= limit) {
      from = std::min(from, i);
      to = std::max(to, i);
    }
  return {from, to};
}

} // namespace

Fit bilinear_fit(const FitProblem& problem) {
  const VectorXd x = as_vector(problem.points.x), y = as_vector(problem.points.y);
  const KinkRange range = range_of_kinks(problem.points.x);
  const std::vector<double> squares = profile_of_squares(x, y, range);
  const int best = static_cast<int>(std::min_element(squares.begin(), squares.end()) - squares.begin());
  const double kink = range.at(best);
  const auto solution = lines_through(x, y, kink);
  if (!solution) refuse_undetermined(problem, "x hardly varies");
  const auto freedom = static_cast<std::size_t>(x.size()) - 4;
  // Profile interval of the kink: all kinks whose sum of squares is no larger than chance allows (Student's t). The
  // least sum of squares is kept above 0 for points that lie on two lines to within rounding.
  const double t = student_t_95(freedom);
  const double least = std::max(solution->squares, 1e-24 * y.squaredNorm());
  const auto [from, to] = kinks_within(squares, least * (1 + t * t / static_cast<double>(freedom)), best);
  // Half widths at the best kink, widened for the degree of freedom that the kink takes.
  const double widen =
      t / student_t_95(freedom + 1) * std::sqrt(static_cast<double>(freedom + 1) / static_cast<double>(freedom));

  Fit result;
  result.coefficients.push_back({"kink", kink, std::max(range.low, range.at(from) - range.step()),
                                 std::min(range.high, range.at(to) + range.step())});
  const VectorXd p = solution->parameters;
  const std::vector<std::string> names = {"y_kink", "slope_below", "slope_above"};
  for (Index i = 0; i < 3; ++i)
    result.coefficients.push_back(symmetric(names[static_cast<std::size_t>(i)], p[i], widen * solution->half_width[i]));
  set_quality(result, y, solution->squares);
  if (from == 0 || to == kinks)
    result.notes.emplace_back(
        "the interval of the kink reaches the last points on one side: two lines fit hardly better than one");
  result.at = [kink, p](double at, double) { return p[0] + (at < kink ? p[1] : p[2]) * (at - kink); };
  return result;
}

} // namespace mpfem
