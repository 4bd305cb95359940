// Size distributions against closed forms.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "pack-gen/size_distribution.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;

namespace {

/// Largest distance between the sample's empirical number-cumulative curve and the distribution (Kolmogorov).
double kolmogorov_distance(std::vector<double> diameter, const SizeDistribution& distribution) {
  std::sort(diameter.begin(), diameter.end());
  const auto n = static_cast<double>(diameter.size());
  double distance = 0;
  for (std::size_t i = 0; i < diameter.size(); ++i) {
    const double target = distribution.cumulative_number(diameter[i]);
    distance = std::max(
        {distance, std::abs(target - static_cast<double>(i) / n), std::abs(target - static_cast<double>(i + 1) / n)});
  }
  return distance;
}

} // namespace

TEST_CASE("a table by number is piecewise linear, and its inverse is its inverse") {
  const auto table = table_distribution({0.1, 0.2, 0.4}, {0, 0.5, 1}, SizeWeight::number);
  CHECK(test::within(table->cumulative_number(0.15), 0.25, test::rounding));
  CHECK(test::within(table->cumulative_number(0.3), 0.75, test::rounding));
  CHECK(table->cumulative_number(0.05) == 0);
  CHECK(table->cumulative_number(0.5) == 1);
  for (const double f : {0.0, 0.1, 0.5, 0.77, 1.0})
    CHECK(table->cumulative_number(table->quantile(f)) == Approx(f).margin(1e-14));
}

TEST_CASE("a table by volume gives a sample whose volumes follow the table") {
  const std::vector<double> size{0.1, 0.15, 0.3}, cumulative{0, 0.3, 1};
  const auto table = table_distribution(size, cumulative, SizeWeight::volume);
  const int count = 200000; // sampling error about 1/count of the number, amplified by (0.3/0.1)^3
  const auto sample = table->sample(count);
  const double total = total_sphere_volume(sample);
  for (const auto& [d, expected] : std::vector<std::pair<double, double>>{
           {0.125, 0.15}, {0.15, 0.3}, {0.2, 0.3 + 0.7 / 3}, {0.25, 0.3 + 1.4 / 3}}) {
    const double limit = d;
    double below = 0;
    for (const double x : sample)
      if (x <= limit) below += std::numbers::pi / 6 * x * x * x;
    CHECK(below / total == Approx(expected).epsilon(1e-3));
  }
}

TEST_CASE("a log-normal distribution has the requested median and deviation, by number and by volume") {
  const double median = 0.14, deviation = 0.2;
  const auto by_number = log_normal_distribution(median, deviation, SizeWeight::number, 0.03, 0.7);
  CHECK(by_number->quantile(0.5) == Approx(median).epsilon(1e-6));
  CHECK(std::log(by_number->quantile(0.841344746) / median) == Approx(deviation).epsilon(1e-4));
  // Hatch & Choate: the number median of a volume distribution is smaller by exp(-3 s^2).
  const auto by_volume = log_normal_distribution(median, deviation, SizeWeight::volume, 0.03, 0.7);
  CHECK(by_volume->quantile(0.5) == Approx(median * std::exp(-3 * deviation * deviation)).epsilon(1e-6));
}

TEST_CASE("a small sample follows the curve as closely as quantiles can") {
  const auto table = table_distribution({0.1, 0.13, 0.21}, {0, 0.6, 1}, SizeWeight::number);
  for (const int count : {5, 25, 329}) CHECK(kolmogorov_distance(table->sample(count), *table) <= 0.5 / count + 1e-12);
}

TEST_CASE("sizes scaled for a density have it") {
  const auto table = table_distribution({0.1, 0.13, 0.21}, {0, 0.6, 1}, SizeWeight::number);
  std::vector<double> sizes = table->sample(100);
  const double scale = size_scale(sizes, 0.5, 0.7);
  for (double& d : sizes) d *= scale;
  CHECK(total_sphere_volume(sizes) == Approx(0.35).epsilon(1e-14));
}

TEST_CASE("distributions that make no sense are refused") {
  CHECK_THROWS_AS(table_distribution({0.1, 0.2}, {0, 0.9}, SizeWeight::number), InputError); // does not end at 1
  CHECK_THROWS_AS(table_distribution({0.1, 0.2, 0.3}, {0, 0.6, 0.5}, SizeWeight::number), InputError);
  CHECK_THROWS_AS(table_distribution({0.2, 0.1}, {0, 1}, SizeWeight::number), InputError);
  CHECK_THROWS_AS(table_distribution({0, 0.1}, {0, 1}, SizeWeight::volume), InputError);
  CHECK_THROWS_AS(table_distribution({0.1}, {1}, SizeWeight::number), InputError);
  CHECK_THROWS_AS(log_normal_distribution(0.1, 0.1, SizeWeight::number, 5, 6), InputError);
  CHECK_THROWS_AS(list_distribution({}), InputError);
  CHECK_THROWS_AS(list_distribution({0.1, -0.1}), InputError);
  CHECK_THROWS_AS(list_distribution({0.1, 0.2})->sample(3), InputError);
}
