// Lines, smoothing, Student's t and least squares against closed forms and simulated noise.

#include <catch2/catch.hpp>

#include "postproc/fits/least_squares.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/smoothing.hpp"
#include "stage_run.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("Student's t has the values of the tables") {
  // Abramowitz & Stegun, table 26.10, to the printed digits.
  for (const auto& [freedom, value] : std::vector<std::pair<std::size_t, double>>{{1, 12.706},
                                                                                  {2, 4.303},
                                                                                  {3, 3.182},
                                                                                  {4, 2.776},
                                                                                  {5, 2.571},
                                                                                  {10, 2.228},
                                                                                  {30, 2.042},
                                                                                  {60, 2.000},
                                                                                  {120, 1.980},
                                                                                  {100000, 1.960}})
    CHECK(std::abs(student_t_95(freedom) - value) <= 5.1e-4);
}

TEST_CASE("a line through points on a line is that line, by both methods") {
  std::vector<double> x, y;
  for (int i = 0; i < 9; ++i) {
    x.push_back(0.1 * i * i);
    y.push_back(3 - 2 * x.back());
  }
  for (const Line& line : {least_squares_line(x, y), theil_sen_line(x, y)}) {
    CHECK(within(line.slope, -2, accumulated_rounding));
    CHECK(within(line.intercept, 3, accumulated_rounding));
    CHECK(line.slope_half_width < 1e-10);
  }
}

TEST_CASE("a value is first crossed while a column rises or falls, also at a row, and only between the rows given") {
  const std::vector<double> column = {0, 0, 2, 6, 6, 3, 1, 4};
  const auto at = [&](std::size_t first, std::size_t last, double value) {
    const auto found = first_crossing(column, first, last, value);
    return found ? static_cast<double>(found->row) + found->fraction : -1;
  };
  CHECK(at(0, 7, 3) == 2.25);
  CHECK(at(0, 7, 6) == 3);
  CHECK(at(0, 7, 0) == 1); // where it leaves that value
  CHECK(at(3, 7, 2) == 5.5);
  CHECK(at(3, 5, 2) == -1);
  CHECK(at(0, 7, 7) == -1);
  CHECK(at(3, 4, 6) == -1); // nothing changes
}

TEST_CASE("a quarter of outliers hardly moves Theil and Sen's slope") {
  Noise noise(1);
  std::vector<double> x, y;
  for (int i = 0; i < 40; ++i) {
    x.push_back(i);
    y.push_back(2.0 * i + 0.1 * noise() + (i % 4 == 3 ? 1000.0 : 0.0));
  }
  // Pairs of a good with a bad point lean to both sides, slightly unevenly: the median moves by a few per cent where
  // the least squares slope is wrong by more than a half.
  CHECK(within(theil_sen_line(x, y).slope, 2, 0.05));
  CHECK(std::abs(least_squares_line(x, y).slope - 2) > 0.5);
}

TEST_CASE(
    "the 95 % interval of Theil and Sen's slope holds the slope in about 95 % of 400 trials, with ringing in most") {
  for (const double memory : {0.0, 0.6}) {
    Noise noise(7);
    int held = 0;
    for (int trial = 0; trial < 400; ++trial) {
      std::vector<double> x, y;
      double ringing = 0;
      for (int i = 0; i < 60; ++i) {
        ringing = memory * ringing + noise();
        x.push_back(i);
        y.push_back(0.5 * i + ringing);
      }
      const Line line = theil_sen_line(x, y);
      held += std::abs(line.slope - 0.5) <= line.slope_half_width;
    }
    INFO(memory << ": " << held);
    // 400 trials at 95 %: 380 +- 3 * 4.4. The estimate of the memory from 60 rows costs some coverage.
    CHECK(held >= (memory > 0 ? 340 : 366));
  }
}

TEST_CASE("local parabolas leave parabolas as they are, up to the ends, and halve white noise") {
  std::vector<double> y;
  for (int i = 0; i < 30; ++i) y.push_back(1 - 0.3 * i + 0.02 * i * i);
  const std::vector<double> smooth = local_parabolas(y, 4);
  for (std::size_t i = 0; i < y.size(); ++i) CHECK(std::abs(smooth[i] - y[i]) < 1e-12);
  Noise noise(3);
  std::vector<double> white(2000);
  for (double& value : white) value = noise();
  const std::vector<double> calm = local_parabolas(white, 4);
  double squares = 0;
  for (std::size_t i = 4; i + 4 < white.size(); ++i) squares += calm[i] * calm[i];
  // Variance at the middle of nine rows: 59/231 (Savitzky and Golay); 2000 rows give it to some per cent.
  CHECK(within(squares / 1992, 59.0 / 231.0, 0.1));
  CHECK(smoothing_half_rows(10) == 3);
  CHECK(smoothing_half_rows(200) == 4);
  CHECK(smoothing_half_rows(1000) == 20);
}

TEST_CASE("Levenberg and Marquardt's method finds the minimum of Rosenbrock's valley") {
  const ResidualFunction rosenbrock = [](const Eigen::VectorXd& p, Eigen::VectorXd& residual,
                                         Eigen::MatrixXd& jacobian) {
    residual.resize(2);
    jacobian.resize(2, 2);
    residual << 10 * (p[1] - p[0] * p[0]), 1 - p[0];
    jacobian << -20 * p[0], 10, -1, 0;
    return true;
  };
  const auto solution = levenberg_marquardt(rosenbrock, Eigen::Vector2d(-1.2, 1));
  REQUIRE(solution);
  CHECK(within(solution->parameters[0], 1, 1e-8));
  CHECK(within(solution->parameters[1], 1, 1e-8));
  CHECK(solution->squares < 1e-16);
}

TEST_CASE("linear least squares have the textbook's interval, and none where columns depend on each other") {
  const std::vector<double> x = {1, 2, 3, 4, 5}, y = {1.1, 1.9, 3.2, 3.8, 5.1};
  Eigen::MatrixXd basis(5, 2);
  for (int i = 0; i < 5; ++i) basis.row(i) << 1, x[static_cast<std::size_t>(i)];
  const auto solution = linear_least_squares(basis, Eigen::Map<const Eigen::VectorXd>(y.data(), 5));
  REQUIRE(solution);
  const Line line = least_squares_line(x, y);
  CHECK(within(solution->parameters[1], line.slope, accumulated_rounding));
  CHECK(within(solution->half_width[1], line.slope_half_width, 1e-8));
  basis.col(1) = 2 * basis.col(0);
  CHECK_FALSE(linear_least_squares(basis, Eigen::VectorXd::Ones(5)));
}

TEST_CASE("a parabola through points on one has its values and no scatter; one point off tells the scatter") {
  const auto exact = [](double x) { return 2 + 4.4 * (x - 1e-3) / 1e-3 - 2.7 * std::pow((x - 1e-3) / 1e-3, 2); };
  const std::vector<double> x = {1e-3, 1.1e-3, 1.3e-3, 1.35e-3, 1.5e-3};
  std::vector<double> y;
  for (const double at : x) y.push_back(exact(at));
  const Parabola through = least_squares_parabola(x, y);
  CHECK(through.freedom == 2);
  CHECK(through.scatter < 1e-12);
  CHECK(within(through.at(1.2e-3), exact(1.2e-3), 1e-12));
  // Five even points, the middle one off by 1: what is left is along (1, -4, 6, -4, 1) / sqrt(70) and (1, -2, 0, 2, -1)
  // / sqrt(10), which is orthogonal to it: 36 / 70 in square.
  const std::vector<double> even = {0, 1, 2, 3, 4}, off = {0, 0, 1, 0, 0};
  CHECK(within(least_squares_parabola(even, off).scatter, std::sqrt(36.0 / 70 / 2), 1e-12));
}

TEST_CASE("parabolas leave the share of the noise that Savitzky and Golay's weights leave") {
  // Their sums of squared weights for 7 and 9 rows: 7/21 and 59/231, the weights of the middle row themselves.
  CHECK(within(noise_left_by_parabolas(3), 7.0 / 21, rounding));
  CHECK(within(noise_left_by_parabolas(4), 59.0 / 231, rounding));
}

TEST_CASE("a ratio of sums has its value and the interval of the formula") {
  // y - x / 2: 0, 1, -1. Variance 3/2 * 2 / 8^2, Student's t of two degrees of freedom 4.3027.
  const Ratio ratio = ratio_of_sums(std::vector<double>{1, 2, 1}, std::vector<double>{2, 2, 4});
  CHECK(ratio.value == 0.5);
  CHECK(within(ratio.half_width, 4.3027 * std::sqrt(3.0 / 64), 1e-4));
  CHECK(std::isnan(ratio_of_sums(std::vector<double>{1}, std::vector<double>{4}).half_width));
}

TEST_CASE("a standard deviation is known as well as its interval says, normal or not") {
  CHECK(within(standard_deviation(std::vector<double>{1, 2, 3, 6}).value, std::sqrt(14.0 / 3), rounding));
  CHECK(std::isnan(standard_deviation(std::vector<double>{4}).half_width));
  CHECK(standard_deviation(std::vector<double>{4, 4, 4}).half_width == 0);
  Noise noise(31);
  int held_normal = 0, held_uniform = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<double> normal, uniform;
    for (int i = 0; i < 100; ++i) {
      normal.push_back(noise());
      uniform.push_back(std::erf(noise() / std::sqrt(2.0))); // between -1 and 1
    }
    const Ratio of_normal = standard_deviation(normal), of_uniform = standard_deviation(uniform);
    held_normal += std::abs(of_normal.value - 1) <= of_normal.half_width;
    held_uniform += std::abs(of_uniform.value - 1 / std::sqrt(3.0)) <= of_uniform.half_width;
    CHECK(of_normal.half_width < 0.3); // 2 / sqrt(2 * 100) in the mean
  }
  // 95 +- 3 * 1.1 %; of a hundred normal values the fourth moment comes out low, which costs two per cent.
  CHECK(held_normal >= 0.895 * 400);
  CHECK(held_uniform >= 0.915 * 400);
  CHECK(held_uniform <= 0.985 * 400);
}
