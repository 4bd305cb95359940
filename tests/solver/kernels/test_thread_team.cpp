#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <pthread.h>
#include <signal.h>

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

/// Holds a thread where it is, by a signal whose handler waits, as a busy machine does that gives its core to another
/// program. The thread goes on when this goes out of scope, or by itself after some seconds.
class HeldThread {
public:
  explicit HeldThread(pthread_t thread) {
    release_ = false, held_ = false, late_ = false;
    struct sigaction action {};
    action.sa_handler = hold;
    sigaction(SIGUSR1, &action, &before_);
    pthread_kill(thread, SIGUSR1);
    while (!held_) std::this_thread::yield();
  }
  ~HeldThread() {
    release_ = true;
    while (held_) std::this_thread::yield();
    sigaction(SIGUSR1, &before_, nullptr);
  }
  HeldThread(const HeldThread&) = delete;
  HeldThread& operator=(const HeldThread&) = delete;
  /// Whether the thread is still held.
  bool is_held() const { return held_ && !late_; }

private:
  static void hold(int) {
    held_ = true;
    for (int i = 0; i < 5000 && !release_; ++i) {
      const timespec millisecond{0, 1000000};
      nanosleep(&millisecond, nullptr);
    }
    late_ = !release_;
    held_ = false;
  }
  static inline std::atomic<bool> release_, held_, late_;
  struct sigaction before_ {};
};

/// The thread of a team of two that is not the calling one.
pthread_t other_thread(ThreadTeam& team) {
  std::atomic<int> arrived{0};
  pthread_t other{};
  team.for_each(2, [&](int, int thread) {
    if (thread == 1) other = pthread_self();
    ++arrived;
    while (arrived.load() < 2) std::this_thread::yield();
  });
  return other;
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

TEST_CASE("The exception of the lowest failing item is rethrown on any number of threads") {
  for (const int threads : {1, 2, 4}) {
    ThreadTeam team(threads);
    for (int repetition = 0; repetition < 200; ++repetition) CHECK(message_of_failure(team, 50, 17) == "item 17");
    CHECK(message_of_failure(team, 1, 0) == "item 0");
    CHECK(message_of_failure(team, 50, 50) == "nothing thrown");
  }
}

TEST_CASE("Ranges hold every item once, and few neighbouring items each") {
  for (const int threads : {1, 2, 4}) {
    ThreadTeam team(threads);
    for (const int count : {0, 1, 7, 8, 9, 500}) {
      std::vector<int> visited(static_cast<std::size_t>(count), 0);
      std::atomic<int> largest{0}, empty{0};
      team.for_each_range(count, [&](int begin, int end, int) {
        if (begin >= end) ++empty;
        int before = largest;
        while (before < end - begin && !largest.compare_exchange_weak(before, end - begin)) {
        }
        for (int item = begin; item < end; ++item) ++visited[static_cast<std::size_t>(item)];
      });
      CAPTURE(threads, count);
      CHECK(visited == std::vector<int>(static_cast<std::size_t>(count), 1));
      CHECK(empty == 0);
      CHECK(largest <= ThreadTeam::most_together);
      if (count == 500) CHECK(largest > 1);
    }
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

TEST_CASE("A loop does not wait for a thread that has begun none of its items") {
  ThreadTeam team(2);
  const HeldThread held(other_thread(team));
  for (const int count : {1, 2, 100})
    CHECK(visits(team, count) == std::vector<int>(static_cast<std::size_t>(count), 1));
  CHECK(message_of_failure(team, 50, 17) == "item 17");
  CHECK(held.is_held());
}

TEST_CASE("A thread that comes late to a loop takes items of the present one only") {
  ThreadTeam team(2);
  const pthread_t other = other_thread(team);
  for (int repetition = 0; repetition < 50; ++repetition) {
    {
      const HeldThread held(other);
      for (int round = 0; round < 3; ++round) CHECK(visits(team, 5) == std::vector<int>(5, 1));
    }
    // It wakes now, to rounds that have ended and others that begin.
    for (int round = 0; round < 20; ++round) CHECK(visits(team, 7) == std::vector<int>(7, 1));
  }
}

TEST_CASE("A hundred thousand loops of few items on more threads than cores run each item once, in its own loop") {
  ThreadTeam team(2 * static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
  std::atomic<int> present{0};
  std::atomic<long> runs{0}, strays{0};
  long expected = 0;
  for (int round = 0; round < 100000; ++round) {
    present.store(round);
    const int count = round % 5;
    std::vector<int> visited(static_cast<std::size_t>(count), 0);
    team.for_each(count, [&, round](int item, int) {
      if (present.load() != round || ++visited[static_cast<std::size_t>(item)] != 1) ++strays;
      ++runs;
    });
    expected += count;
  }
  CHECK(runs.load() == expected);
  CHECK(strays.load() == 0);
}

TEST_CASE("A team without threads is refused") {
  CHECK_THROWS_AS(ThreadTeam(0), std::invalid_argument);
  CHECK_THROWS_AS(ThreadTeam(-1), std::invalid_argument);
}
