// Packings: gaps, densities, reproducibility.

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "pack-gen/packing.hpp"
#include "pack-gen/size_distribution.hpp"

using namespace mpfem;

namespace {

/// Smallest gap by looking at every pair and wall.
double brute_force_gap(const SpherePacking& p) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      smallest = std::min({smallest, p.center[i][k] - p.radius[i], p.box[k] - p.center[i][k] - p.radius[i]});
    for (std::size_t j = 0; j < i; ++j) {
      const double d =
          std::hypot(p.center[i][0] - p.center[j][0], p.center[i][1] - p.center[j][1], p.center[i][2] - p.center[j][2]);
      smallest = std::min(smallest, d - p.radius[i] - p.radius[j]);
    }
  }
  return smallest;
}

PackingRequest request(int count, double density, std::uint64_t seed) {
  const auto table = table_distribution({0.1, 0.14, 0.21}, {0, 0.6, 1}, SizeWeight::number);
  std::vector<double> radius = table->sample(count);
  for (double& r : radius) r *= 0.5;
  double volume = 0;
  for (const double r : radius) volume += 4.0 / 3.0 * M_PI * r * r * r;
  const double edge = std::cbrt(volume / density);
  return {.box = {edge, edge, edge}, .radius = radius, .smallest_gap = 0.002, .seed = seed};
}

} // namespace

TEST_CASE("a packing denser than random sequential addition keeps every gap and the exact density") {
  // Random sequential addition of spheres ends near 0.38 (0.36 … 0.40 with sizes mixed).
  for (const auto& [count, density] : {std::pair{300, 0.56}, {60, 0.48}}) {
    const PackingRequest wanted = request(count, density, 3);
    const SpherePacking packing = pack_spheres(wanted);
    CHECK(packing.radius == wanted.radius);
    CHECK(relative_density(packing) == Approx(density).epsilon(1e-12));
    const double gap = brute_force_gap(packing);
    CHECK(gap >= wanted.smallest_gap * (1 - 1e-12));
    CHECK(smallest_gap(packing).gap == Approx(gap).epsilon(1e-12));
  }
}

TEST_CASE("the same seed gives the same packing, another seed another one") {
  const SpherePacking a = pack_spheres(request(80, 0.45, 7)), b = pack_spheres(request(80, 0.45, 7)),
                      c = pack_spheres(request(80, 0.45, 8));
  CHECK(a.center == b.center);
  CHECK(a.center != c.center);
}

TEST_CASE("a density beyond jamming is refused with the density that was reached") {
  PackingRequest wanted = request(40, 0.66, 1);
  wanted.moves = 200'000; // enough to see that it does not go on
  CHECK_THROWS_WITH(pack_spheres(wanted), Catch::Contains("0.66") && Catch::Contains("reached"));
  CHECK_THROWS_AS(pack_spheres(wanted), InputError);
}

TEST_CASE("a sphere larger than the box is refused") {
  CHECK_THROWS_AS(pack_spheres({.box = {1, 1, 0.1}, .radius = {0.06}, .smallest_gap = 0.001}), InputError);
}
