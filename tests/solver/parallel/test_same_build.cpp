#include <string>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "solver/parallel/same_build.hpp"
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
