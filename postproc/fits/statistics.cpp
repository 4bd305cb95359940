#include "postproc/fits/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace mpfem {

namespace {

/// Probability that |t| stays below `t`.
double student_t_probability(double t, std::size_t degrees_of_freedom) {
  const double nu = static_cast<double>(degrees_of_freedom);
  const double theta = std::atan(t / std::sqrt(nu)), cosine = std::cos(theta), sine = std::sin(theta);
  const bool odd = degrees_of_freedom % 2 == 1;
  double term = odd ? cosine : 1.0, sum = 0;
  for (std::size_t k = odd ? 3 : 2; k <= degrees_of_freedom; k += 2) {
    sum += term;
    const auto order = static_cast<double>(k);
    term *= cosine * cosine * (order - 1) / order;
  }
  return odd ? 2 / std::numbers::pi * (theta + sine * sum) : sine * sum;
}

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

} // namespace

WeightedPercentiles::WeightedPercentiles(std::vector<std::pair<double, double>> value_and_weight)
    : value_and_weight_(std::move(value_and_weight)) {
  for (const auto& [value, weight] : value_and_weight_) total_ += weight;
  std::sort(value_and_weight_.begin(), value_and_weight_.end());
}

double WeightedPercentiles::at(double share) const {
  double sum = 0;
  for (const auto& [value, weight] : value_and_weight_)
    if ((sum += weight) >= share * total_) return value;
  return value_and_weight_.empty() ? 0.0 : value_and_weight_.back().first;
}

double student_t_95(std::size_t degrees_of_freedom) {
  if (degrees_of_freedom > 10000) return 1.95996;
  double low = 1.9, high = 13;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_probability(middle, degrees_of_freedom) < 0.95 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Line least_squares_line(std::span<const double> x, std::span<const double> y) {
  const double mean_x = mean(x), mean_y = mean(y);
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  Line line;
  line.slope = xy / xx;
  line.intercept = mean_y - line.slope * mean_x;
  if (x.size() < 3) return line;
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - line.intercept - line.slope * x[i];
    squares += residual * residual;
  }
  const std::size_t freedom = x.size() - 2;
  line.scatter = std::sqrt(squares / static_cast<double>(freedom));
  const double interval = student_t_95(freedom) * line.scatter;
  line.slope_half_width = interval / std::sqrt(xx);
  line.intercept_half_width = interval * std::sqrt(1.0 / static_cast<double>(x.size()) + mean_x * mean_x / xx);
  return line;
}

double noise_left_by_parabolas(std::size_t half_rows) {
  const auto m = static_cast<double>(half_rows);
  return 3 * (3 * m * m + 3 * m - 1) / ((2 * m - 1) * (2 * m + 1) * (2 * m + 3));
}

Parabola least_squares_parabola(std::span<const double> x, std::span<const double> y) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  Parabola parabola;
  parabola.centre = 0.5 * (*low + *high);
  if (*high > *low) parabola.scale = 0.5 * (*high - *low);
  const auto points = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd basis(points, 3);
  for (Eigen::Index i = 0; i < points; ++i) {
    const double t = (x[static_cast<std::size_t>(i)] - parabola.centre) / parabola.scale;
    basis.row(i) << 1, t, t * t;
  }
  // Offsets from the first value, so that a constant stays one without rounding.
  const Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(y.data(), points).array() - y.front();
  const Eigen::Vector3d c = basis.colPivHouseholderQr().solve(values);
  parabola.coefficient = {y.front() + c[0], c[1], c[2]};
  parabola.freedom = x.size() - 3;
  if (parabola.freedom > 0)
    parabola.scatter = (values - basis * c).norm() / std::sqrt(static_cast<double>(parabola.freedom));
  return parabola;
}

Ratio ratio_of_sums(std::span<const double> y, std::span<const double> x) {
  double sum_y = 0, sum_x = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum_y += y[i];
    sum_x += x[i];
  }
  Ratio ratio;
  ratio.value = sum_y / sum_x;
  if (x.size() < 2) return ratio;
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - ratio.value * x[i];
    squares += residual * residual;
  }
  const auto n = static_cast<double>(x.size());
  ratio.half_width = student_t_95(x.size() - 1) * std::sqrt(n / (n - 1) * squares) / sum_x;
  return ratio;
}

Ratio standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return {};
  const double centre = mean(values), n = static_cast<double>(values.size());
  double squares = 0, fourths = 0;
  for (const double value : values) {
    const double square = (value - centre) * (value - centre);
    squares += square;
    fourths += square * square;
  }
  const double variance = squares / (n - 1);
  if (!(variance > 0)) return {0, 0};
  const double variance_of_variance = std::max(0.0, (fourths / n - variance * variance) / n);
  return {std::sqrt(variance),
          student_t_95(values.size() - 1) * std::sqrt(variance_of_variance) / (2 * std::sqrt(variance))};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

Line theil_sen_line(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = x.size();
  std::vector<double> slopes;
  slopes.reserve(n * (n - 1) / 2);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (x[j] != x[i]) slopes.push_back((y[j] - y[i]) / (x[j] - x[i]));
  std::sort(slopes.begin(), slopes.end());
  Line line;
  line.slope = median(slopes);
  line.intercept = median({y.begin(), y.end()}) - line.slope * median({x.begin(), x.end()});
  if (n < 3) return line;

  std::vector<double> residual(n);
  for (std::size_t i = 0; i < n; ++i) residual[i] = y[i] - line.intercept - line.slope * x[i];
  const double centre = mean(residual);
  double squares = 0, products = 0;
  for (std::size_t i = 0; i < n; ++i) {
    squares += (residual[i] - centre) * (residual[i] - centre);
    if (i > 0) products += (residual[i] - centre) * (residual[i - 1] - centre);
  }
  line.scatter = std::sqrt(squares / static_cast<double>(n - 2));
  const double lag = squares > 0 ? std::clamp(products / squares, 0.0, 0.95) : 0.0;

  const auto points = static_cast<double>(n), pairs = static_cast<double>(slopes.size());
  const double spread =
      1.96 * std::sqrt(points * (points - 1) * (2 * points + 5) / 18) * std::sqrt((1 + lag) / (1 - lag));
  const auto at = [&](double rank) { return slopes[static_cast<std::size_t>(std::clamp(rank, 0.0, pairs - 1))]; };
  line.slope_half_width = 0.5 * (at(std::ceil(0.5 * (pairs + spread))) - at(std::floor(0.5 * (pairs - spread)) - 1));
  return line;
}

std::vector<double> local_parabolas(std::span<const double> y, std::size_t half_rows) {
  const std::size_t n = y.size(), width = 2 * half_rows + 1;
  std::vector<double> smoothed(n);
  // Rows as abscissa, scaled to -1 … 1: every window has the same well-conditioned matrix.
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(width), 3);
  const auto position = [&](std::size_t row_in_window) {
    return (static_cast<double>(row_in_window) - static_cast<double>(half_rows)) / static_cast<double>(half_rows);
  };
  for (std::size_t i = 0; i < width; ++i)
    basis.row(static_cast<Eigen::Index>(i)) << 1, position(i), position(i) * position(i);
  const Eigen::MatrixXd solve = (basis.transpose() * basis).ldlt().solve(basis.transpose());
  for (std::size_t row = 0; row < n; ++row) {
    const std::size_t first = std::min(row > half_rows ? row - half_rows : 0, n - width);
    const Eigen::Map<const Eigen::VectorXd> window(y.data() + first, static_cast<Eigen::Index>(width));
    const Eigen::Vector3d c = solve * window;
    const double at = position(row - first);
    smoothed[row] = c[0] + at * (c[1] + at * c[2]);
  }
  return smoothed;
}

double Crossing::half_spacing(std::span<const double> column) const {
  return fraction > 0 ? 0.5 * std::abs(column[row + 1] - column[row]) : 0.0;
}

std::optional<Crossing> first_crossing(std::span<const double> column, std::size_t first, std::size_t last,
                                       double value) {
  for (std::size_t row = first; row < last; ++row) {
    const auto [low, high] = std::minmax(column[row], column[row + 1]);
    if (low < high && low <= value && value <= high)
      return Crossing{row, (value - column[row]) / (column[row + 1] - column[row])};
  }
  return {};
}

} // namespace mpfem
