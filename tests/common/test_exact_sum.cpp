#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "common/exact_sum.hpp"

using namespace mpfem;

namespace {

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

/// Doubles of both signs with exponents of 2 up to +-`spread`.
std::vector<double> random_terms(int count, int spread, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-spread, spread);
  std::vector<double> terms;
  for (int i = 0; i < count; ++i) terms.push_back(std::ldexp(mantissa(random), exponent(random)));
  return terms;
}

} // namespace

TEST_CASE("An exact sum of one term is that term, and of two terms their correctly rounded sum") {
  for (const int spread : {3, 30, 60, 120}) {
    const std::vector<double> terms = random_terms(20000, spread, 1);
    for (std::size_t i = 0; i + 1 < terms.size(); i += 2) {
      REQUIRE(sum_of({terms[i]}) == terms[i]);
      REQUIRE(sum_of({terms[i], terms[i + 1]}) == terms[i] + terms[i + 1]);
      REQUIRE(sum_of({terms[i], -terms[i]}) == 0);
    }
  }
}

TEST_CASE("An exact sum keeps digits that cancel in a sum of doubles") {
  CHECK(sum_of({1e30, 1, -1e30}) == 1);
  CHECK(sum_of({1e60, 1e-60, -1e60, -3e-60}) == 1e-60 - 3e-60);
  // Half of the last place, rounded to even, and just above half.
  const double last = std::ldexp(1, -52);
  CHECK(sum_of({1, last / 2}) == 1);
  CHECK(sum_of({1, last / 2, 1e-70}) == 1 + last);
  CHECK(sum_of({-1, -last / 2, -1e-70}) == -1 - last);
}

TEST_CASE("An exact sum does not depend on the order of its terms or on how they are divided among partial sums") {
  std::vector<double> terms = random_terms(5000, 100, 2);
  const double whole = sum_of(terms);
  std::mt19937_64 random(3);
  for (int repetition = 0; repetition < 20; ++repetition) {
    std::shuffle(terms.begin(), terms.end(), random);
    REQUIRE(sum_of(terms) == whole);
    ExactSum part[3];
    for (const double term : terms) part[random() % 3].add(term);
    for (std::size_t word = 0; word < ExactSum::words; ++word)
      part[0].data()[word] += part[1].data()[word] + part[2].data()[word];
    REQUIRE(part[0].value() == whole);
  }
}

TEST_CASE("An exact sum of 400,000 terms of a series is its known value") {
  for (const double sign : {1.0, -1.0}) {
    ExactSum sum;
    double weights = 0;
    for (int weight = 1; weight <= 1000; ++weight) {
      weights += weight;
      for (int i = 0; i < 200; ++i) { // 2^-i - 2^-(i + 1) leaves 1 - 2^-200
        sum.add(sign * weight * std::ldexp(1, -i));
        sum.add(-sign * weight * std::ldexp(1, -i - 1));
      }
    }
    CHECK(sum.value() == sign * weights);
    sum.add(-sign * weights);
    CHECK(sum.value() == -sign * weights * std::ldexp(1, -200));
  }
}

TEST_CASE("An exact sum is NaN if a term is not finite or the sum is out of range") {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {infinite, -infinite, std::numeric_limits<double>::quiet_NaN(), 1e80, -1e300}) {
    ExactSum sum;
    sum.add(1);
    sum.add(bad);
    CHECK(std::isnan(sum.value()));
  }
  CHECK(sum_of({1e73, 1e73}) == 2e73);
  const double large = std::ldexp(1, 243);
  CHECK(sum_of(std::vector<double>(8191, large)) == 8191 * large);
  CHECK(sum_of(std::vector<double>(8191, -large)) == -8191 * large);
  CHECK(std::isnan(sum_of(std::vector<double>(8192, large)))); // 2^256
}

TEST_CASE("An exact sum cuts bits off below 2^-256") {
  CHECK(sum_of({1e-300, std::numeric_limits<double>::denorm_min()}) == 0);
  const double low = std::ldexp(1, -256);
  CHECK(sum_of({low}) == low);
  CHECK(sum_of({1.5 * low}) == low);
  CHECK(sum_of({-1.5 * low}) == -low);
}
