#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/parallel/same_on_all_ranks.hpp"
#include "test_ranks.hpp"

using namespace mpfem;
using test::test_ranks;

TEST_CASE("Ranks of one build go on together, and those of two builds are refused on all ranks alike") {
  const Communicator& ranks = test_ranks();
  CHECK_NOTHROW(refuse_different_builds(ranks, "mpfem 1 with 8 numbers a vector"));
  const std::string own = ranks.rank() + 1 == ranks.size() ? "mpfem 1 with 4 numbers a vector" : "mpfem 1 with 8";
  if (ranks.alone())
    CHECK_NOTHROW(refuse_different_builds(ranks, own));
  else
    CHECK_THROWS_WITH(refuse_different_builds(ranks, own),
                      Catch::Contains("mpfem 1 with 8 on rank 0 and mpfem 1 with 4 numbers a vector on rank") &&
                          Catch::Contains("one build on all ranks"));
}

TEST_CASE("Ranks that are told different things hear the first line that differs") {
  const Communicator& ranks = test_ranks();
  const std::string common = "--resume false\n[material]\n";
  CHECK_NOTHROW(refuse_differences(ranks, common, "one scenario"));
  if (ranks.alone()) return;
  const bool last = ranks.rank() + 1 == ranks.size();
  const std::string allowed = fmt::format("on rank {}, allowed: one scenario", ranks.size() - 1);
  CHECK_THROWS_WITH(refuse_differences(ranks, common + (last ? "nu = 0.2\nx = 1" : "nu = 0.3\nx = 1"), "one scenario"),
                    "found nu = 0.3 on rank 0 and nu = 0.2 " + allowed);
  CHECK_THROWS_WITH(refuse_differences(ranks, last ? common : common + "nu = 0.3\n", "one scenario"),
                    "found nu = 0.3 on rank 0 and nothing more " + allowed);
}
