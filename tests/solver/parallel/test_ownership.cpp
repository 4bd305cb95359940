// Which rank owns which grain, and how values of grains are gathered.

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/parallel/grain_values.hpp"
#include "solver/parallel/ownership.hpp"

using namespace mpfem;

namespace {

using Centres = std::vector<std::array<double, 3>>;
using Weights = std::vector<double>;

/// Random places in a box (mm) and weights between 1 and `largest`.
struct Heap {
  Centres centre;
  Weights weight;
};
Heap heap(std::size_t grains, const std::array<double, 3>& box, double largest, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Heap result;
  for (std::size_t g = 0; g < grains; ++g) {
    result.centre.push_back({box[0] * uniform(random), box[1] * uniform(random), box[2] * uniform(random)});
    result.weight.push_back(1 + (largest - 1) * uniform(random));
  }
  return result;
}

Weights weights_of_ranks(const std::vector<std::int32_t>& owner, const Weights& weight, int ranks) {
  Weights sums(static_cast<std::size_t>(ranks), 0.0);
  for (std::size_t g = 0; g < owner.size(); ++g) sums[static_cast<std::size_t>(owner[g])] += weight[g];
  return sums;
}

} // namespace

TEST_CASE("ownership lists a rank's own grains in ascending order") {
  const Ownership ownership = ownership_of({1, 0, 1, 2, 1}, 1);
  CHECK(ownership.rank == 1);
  CHECK(ownership.own == std::vector<std::int32_t>{0, 2, 4});
  CHECK(ownership.owns(2));
  CHECK_FALSE(ownership.owns(3));
  CHECK(ownership_of({0, 0}, 1).own.empty());
  CHECK(sole_ownership(3).own == std::vector<std::int32_t>{0, 1, 2});
}

TEST_CASE("a row of equal grains is cut into equal parts, neighbours together") {
  Centres centre;
  for (int g = 0; g < 12; ++g) centre.push_back({0.1, 0.3 * g, 0.2});
  const Weights weight(12, 2.0);
  CHECK(divide_among_ranks(centre, weight, 3) == std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2});
  CHECK(divide_among_ranks(centre, weight, 1) == std::vector<std::int32_t>(12, 0));
}

TEST_CASE("a heavy grain has a rank almost to itself") {
  Centres centre;
  for (int g = 0; g < 5; ++g) centre.push_back({0.3 * g, 0, 0});
  CHECK(divide_among_ranks(centre, Weights{1, 1, 1, 1, 8}, 2) == std::vector<std::int32_t>{0, 0, 0, 0, 1});
}

TEST_CASE("ranks share the weight evenly, within a grain at every cut") {
  const int ranks = GENERATE(2, 3, 4, 7, 16);
  const Heap grains = heap(2000, {1, 2, 3}, 5);
  const auto owner = divide_among_ranks(grains.centre, grains.weight, ranks);
  const double even = std::accumulate(grains.weight.begin(), grains.weight.end(), 0.0) / ranks;
  for (const double sum : weights_of_ranks(owner, grains.weight, ranks)) {
    CAPTURE(ranks, even, sum);
    // A cut misses its share by half of a grain at most, and passes on what the cuts before have missed.
    CHECK(std::abs(sum - even) <= 5.0);
  }
}

TEST_CASE("every rank gets a grain where there are enough, also of very unequal ones") {
  const auto [grains, ranks] = GENERATE(table<std::size_t, int>({{8, 8}, {9, 8}, {13, 5}, {5, 4}, {3, 3}}));
  for (const double largest : {1.0, 1000.0})
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Heap some = heap(grains, {1, 1, 1}, largest, seed);
      const auto owner = divide_among_ranks(some.centre, some.weight, ranks);
      CAPTURE(grains, ranks, largest, seed);
      CHECK(std::set<std::int32_t>(owner.begin(), owner.end()).size() == static_cast<std::size_t>(ranks));
    }
}

TEST_CASE("with fewer grains than ranks each grain has a rank of its own") {
  const Heap few = heap(3, {1, 1, 1}, 2);
  const auto owner = divide_among_ranks(few.centre, few.weight, 8);
  CHECK(std::set<std::int32_t>(owner.begin(), owner.end()).size() == 3);
  CHECK(std::all_of(owner.begin(), owner.end(), [](std::int32_t rank) { return rank >= 0 && rank < 8; }));
  CHECK(divide_among_ranks({}, {}, 4).empty());
}

TEST_CASE("the division depends neither on units nor on where the packing lies") {
  Heap grains = heap(300, {1, 2, 1}, 4);
  const auto owner = divide_among_ranks(grains.centre, grains.weight, 6);
  for (double& weight : grains.weight) weight *= 1024; // powers of two: no rounding
  for (auto& centre : grains.centre)
    for (double& x : centre) x *= 0.25;
  CHECK(divide_among_ranks(grains.centre, grains.weight, 6) == owner);
}

TEST_CASE("grains at the same place are divided by their numbers") {
  const Centres centre(6, {1, 1, 1});
  CHECK(divide_among_ranks(centre, Weights(6, 1.0), 2) == std::vector<std::int32_t>{0, 0, 0, 1, 1, 1});
}

TEST_CASE("one rank has the values of all grains and leaves them as they are") {
  const Communicator alone;
  std::vector<double> values = {3, 1, 2};
  share_of_grains(alone, sole_ownership(3), std::span<double>(values));
  CHECK(values == std::vector<double>{3, 1, 2});
}

TEST_CASE("values of grains come in their order and in pieces of whole grains, grains without any among them") {
  const Communicator alone;
  const std::int64_t most = GENERATE(3, 400'000); // values of a grain: of all a few bytes, or 30 MB
  std::vector<std::int64_t> counts;
  for (int g = 0; g < 20; ++g) counts.push_back(g % 4 == 0 ? 0 : most - g % 3);
  std::vector<double> expected, taken;
  for (std::size_t g = 0; g < counts.size(); ++g)
    expected.insert(expected.end(), static_cast<std::size_t>(counts[g]), static_cast<double>(g));
  std::size_t largest = 0;
  gather_at_root<double>(
      alone, sole_ownership(20), counts,
      [&](std::int32_t grain, std::span<double> values) {
        CHECK(static_cast<std::int64_t>(values.size()) == counts[static_cast<std::size_t>(grain)]);
        std::fill(values.begin(), values.end(), grain);
      },
      [&](std::span<const double> piece) {
        largest = std::max(largest, piece.size());
        taken.insert(taken.end(), piece.begin(), piece.end());
      });
  CHECK((taken == expected));
  if (most > 3) CHECK(largest < taken.size() / 4); // no more than a grain beyond 4 MiB
}
