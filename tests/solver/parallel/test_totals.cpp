#include <catch2/catch.hpp>

#include <numeric>
#include <random>
#include <vector>

#include "solver/parallel/totals.hpp"
#include "test_ranks.hpp"

using namespace mpfem;
using test::test_ranks;

namespace {

struct Load {
  double force = 0, penetration = 0;
  std::int64_t bonds = 0;
  bool admissible = true;

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.force), visit.largest(s.penetration), visit.count(s.bonds), visit.every(s.admissible);
  }
};

/// Loads of `count` grains, the same on all ranks.
std::vector<Load> loads_of(int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Load> loads;
  for (int i = 0; i < count; ++i) loads.push_back({number(random) * 1e6, 1 + number(random), i, i != 3});
  return loads;
}

/// Every size()-th of the grains, from the rank's number on.
std::vector<std::int32_t> own_of(const Communicator& ranks, int count) {
  std::vector<std::int32_t> own;
  for (int grain = ranks.rank(); grain < count; grain += ranks.size()) own.push_back(grain);
  return own;
}

} // namespace

TEST_CASE("Totals over ranks are those of one rank that has all grains, to the last bit") {
  constexpr int grains = 1000;
  const std::vector<Load> loads = loads_of(grains);
  std::vector<std::int32_t> all(grains);
  std::iota(all.begin(), all.end(), 0);
  const Load alone = total_of<Load>(Communicator(), all, loads);
  const Load together = total_of<Load>(test_ranks(), own_of(test_ranks(), grains), loads);
  CHECK(together.force == alone.force);
  CHECK(together.penetration == alone.penetration);
  CHECK(together.bonds == grains * (grains - 1) / 2);
  CHECK(alone.bonds == together.bonds);
  CHECK_FALSE(together.admissible);
}

TEST_CASE("Totals of several quantities stay separate, and show that a rank has failed") {
  Totals<Load> totals(2);
  if (test_ranks().is_root()) totals.add({.force = 1, .penetration = 0.5, .bonds = 2, .admissible = true}, 1);
  totals.add({.force = 3, .penetration = 0.25, .bonds = 0, .admissible = true}, 0);
  CHECK_FALSE(totals.combine(test_ranks()));
  CHECK(totals[0].force == 3.0 * test_ranks().size());
  CHECK(totals[0].penetration == 0.25);
  CHECK(totals[1].force == 1);
  CHECK(totals[1].penetration == 0.5);
  CHECK(totals[1].bonds == 2);
  CHECK(totals[1].admissible);
  Totals<Load> failed;
  CHECK(failed.combine(test_ranks(), test_ranks().rank() == test_ranks().size() - 1));
}

TEST_CASE("The terms of one thing are added to those of another, each in its way") {
  Load sum{.force = 1, .penetration = 0.5, .bonds = 2, .admissible = true};
  add_terms(sum, {.force = 3, .penetration = 0.25, .bonds = 4, .admissible = true});
  CHECK(sum.force == 4);
  CHECK(sum.penetration == 0.5);
  CHECK(sum.bonds == 6);
  CHECK(sum.admissible);
  add_terms(sum, {.admissible = false});
  CHECK_FALSE(sum.admissible);
}
