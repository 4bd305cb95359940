// The loop over independent items on a few threads.

#include <array>
#include <chrono>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <sys/resource.h>

#include <catch2/catch.hpp>

#include "pack-gen/parallel.hpp"

using namespace mpfem;

TEST_CASE("of several failures in a loop on threads, that of the lowest item is reported") {
  for (int repetition = 0; repetition < 20; ++repetition) {
    std::string failure;
    try {
      for_each_parallel(8, 4, [](std::size_t i) {
        if (i == 1) std::this_thread::sleep_for(std::chrono::milliseconds(5)); // the others fail before it
        if (i > 0) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
    CHECK(failure == "1");
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which need more memory
TEST_CASE("a loop is done by fewer threads where no more can be started") {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  REQUIRE(pages > 0);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  rlimit limited = before;
  limited.rlim_cur = pages * 4096 + (64 << 20); // room for the stacks of eight threads, 8 MiB each
  std::array<int, 1000> calls{};
  std::array<std::thread::id, 1000> thread{};
  REQUIRE(setrlimit(RLIMIT_AS, &limited) == 0);
  CHECK_NOTHROW(for_each_parallel(calls.size(), 64, [&](std::size_t i) {
    ++calls[i];
    thread[i] = std::this_thread::get_id();
    std::this_thread::sleep_for(std::chrono::microseconds(100)); // every thread that runs gets items
  }));
  REQUIRE(setrlimit(RLIMIT_AS, &before) == 0);
  for (const int count : calls) REQUIRE(count == 1);
  CHECK(std::set(thread.begin(), thread.end()).size() < 64);
}
#endif
