// How many threads a rank starts.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
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
  std::array<int, 2> pipe_end{};
  REQUIRE(pipe(pipe_end.data()) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string id = machine_id();
    _exit(write(pipe_end[1], id.data(), id.size()) == static_cast<ssize_t>(id.size()) ? 0 : 1);
  }
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  std::string of_child(256, ' ');
  of_child.resize(static_cast<std::size_t>(std::max<ssize_t>(read(pipe_end[0], of_child.data(), of_child.size()), 0)));
  for (const int end : pipe_end) close(end);
  CHECK(status == 0);
  CHECK(!of_child.empty());
  CHECK(machine_id() == of_child);
}
