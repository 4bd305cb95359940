// How many threads a rank starts.

#include <vector>

#include <catch2/catch.hpp>

#include "common/machine_id.hpp"
#include "solver/parallel/share_of_cores.hpp"

using namespace mpfem;

TEST_CASE("Ranks on machines of one kind do not share cores, although the cores have the same numbers") {
  const std::vector<RankPlace> ranks{{"a", {0, 1, 2, 3}}, {"b", {0, 1, 2, 3}}};
  CHECK(share_of_cores(ranks[0], ranks) == 4);
  CHECK(share_of_cores(ranks[1], ranks) == 4);
}

TEST_CASE("Cores that several ranks may use are shared equally, and no rank goes without") {
  const std::vector<RankPlace> bound{{"a", {0, 1}}, {"a", {2, 3}}};
  CHECK(share_of_cores(bound[0], bound) == 2);
  const std::vector<RankPlace> free{{"a", {0, 1, 2, 3}}, {"a", {0, 1, 2, 3}}};
  CHECK(share_of_cores(free[0], free) == 2);
  const std::vector<RankPlace> overlapping{{"a", {0, 1, 2}}, {"a", {2}}};
  CHECK(share_of_cores(overlapping[0], overlapping) == 2);
  const std::vector<RankPlace> crowded(5, RankPlace{"a", {0}});
  CHECK(share_of_cores(crowded[0], crowded) == 1);
}

TEST_CASE("A machine has one name for all its processes") {
  CHECK(!machine_id().empty());
  CHECK(machine_id() == machine_id());
}
