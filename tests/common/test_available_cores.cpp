#include <catch2/catch.hpp>

#include <thread>

#include <sched.h>

#include "common/available_cores.hpp"

using namespace mpfem;

TEST_CASE("the cores available are those to which a process is bound, not the machine's") {
  // In a separate thread, to which the binding is confined.
  std::thread([] {
    cpu_set_t all;
    REQUIRE(sched_getaffinity(0, sizeof all, &all) == 0);
    CHECK(available_cores() == CPU_COUNT(&all));
    int first = 0;
    while (!CPU_ISSET(first, &all)) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
    CHECK(available_cores() == 1);
  }).join();
}
