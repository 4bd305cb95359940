#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/kernels/thread_team.hpp"

using mpfem::ThreadTeam;

namespace {

std::vector<int> visits(ThreadTeam& team, int count) {
  std::vector<int> visited(static_cast<std::size_t>(count), 0);
  team.for_each(count, [&](int item, int) { ++visited[static_cast<std::size_t>(item)]; });
  return visited;
}

/// Message of the exception that a loop throws whose items `failing` and later ones fail.
std::string message_of_failure(ThreadTeam& team, int count, int failing) {
  try {
    team.for_each(count, [&](int item, int) {
      if (item >= failing) throw std::runtime_error("item " + std::to_string(item));
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing thrown";
}

} // namespace

TEST_CASE("Every item runs exactly once, for any number of threads and items") {
  for (const int threads : {1, 2, 3, 4, 8}) {
    ThreadTeam team(threads);
    CHECK(team.size() == threads);
    for (const int count : {0, 1, 2, 3, 7, 100, 1000})
      CHECK(visits(team, count) == std::vector<int>(static_cast<std::size_t>(count), 1));
  }
}

TEST_CASE("Many short loops follow each other without losing an item or a wake-up") {
  ThreadTeam team(4);
  std::vector<long> sum(16, 0);
  constexpr int rounds = 5000;
  for (int round = 0; round < rounds; ++round) {
    team.for_each(16, [&](int item, int) { sum[static_cast<std::size_t>(item)] += item; });
    // Now and then long enough apart that the workers have fallen asleep.
    if (round % 500 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  CHECK(std::accumulate(sum.begin(), sum.end(), 0L) == 120L * rounds);
}

TEST_CASE("Thread numbers lie within the team, and a team of one runs on the calling thread") {
  ThreadTeam team(3);
  std::vector<int> thread_of(200, -1);
  team.for_each(200, [&](int item, int thread) { thread_of[static_cast<std::size_t>(item)] = thread; });
  for (const int thread : thread_of) CHECK((thread >= 0 && thread < 3));

  ThreadTeam alone(1);
  std::set<std::thread::id> ids;
  alone.for_each(10, [&](int, int thread) {
    CHECK(thread == 0);
    ids.insert(std::this_thread::get_id());
  });
  CHECK(ids == std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST_CASE("All threads of a team work, the calling one included") {
  ThreadTeam team(3);
  // Each item waits for the other two, so the loop only ends when three threads run it at once.
  std::atomic<int> arrived{0};
  std::vector<int> thread_of(3, -1);
  team.for_each(3, [&](int item, int thread) {
    thread_of[static_cast<std::size_t>(item)] = thread;
    ++arrived;
    while (arrived.load() < 3) std::this_thread::yield();
  });
  CHECK(std::set<int>(thread_of.begin(), thread_of.end()) == std::set<int>{0, 1, 2});
}

TEST_CASE("The exception of the lowest failing item is rethrown, whatever the number of threads") {
  for (const int threads : {1, 2, 4}) {
    ThreadTeam team(threads);
    for (int repetition = 0; repetition < 200; ++repetition) CHECK(message_of_failure(team, 50, 17) == "item 17");
    CHECK(message_of_failure(team, 1, 0) == "item 0");
    CHECK(message_of_failure(team, 50, 50) == "nothing thrown");
  }
}

TEST_CASE("No items begin after a failure has been seen, and the team works on afterwards") {
  ThreadTeam team(2);
  std::atomic<int> begun{0};
  CHECK_THROWS_AS(team.for_each(1000000,
                                [&](int, int) {
                                  ++begun;
                                  throw std::runtime_error("always");
                                }),
                  std::runtime_error);
  CHECK(begun.load() <= 2 * team.size());
  CHECK(visits(team, 100) == std::vector<int>(100, 1));
}

TEST_CASE("A team without threads is refused") {
  CHECK_THROWS_AS(ThreadTeam(0), std::invalid_argument);
  CHECK_THROWS_AS(ThreadTeam(-1), std::invalid_argument);
}
