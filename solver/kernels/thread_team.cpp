#include "solver/kernels/thread_team.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace mpfem {

namespace {

void pause_briefly() {
#if defined(__x86_64__)
  _mm_pause();
#else
  std::this_thread::yield();
#endif
}

using Clock = std::chrono::steady_clock;

/// Until this time, waiting threads hardly spin: other programs need the cores, which all teams share.
std::atomic<Clock::rep> short_of_cores_until{0};

/// Returns when the atomic no longer holds `old`. The loops of one time step follow each other within microseconds: a
/// short spin saves the sleep and wake-up between them. When cores are short, a core that is released at once can go to
/// the thread that is waited for.
template <class Value>
void wait_while_equal(const std::atomic<Value>& atomic, Value old) {
  const bool cores_are_short =
      Clock::now().time_since_epoch().count() < short_of_cores_until.load(std::memory_order_relaxed);
  const int spins = cores_are_short ? 100 : 2000;
  for (int i = 0; i < spins; ++i) {
    if (atomic.load(std::memory_order_acquire) != old) return;
    pause_briefly();
  }
  atomic.wait(old, std::memory_order_acquire);
}

/// The same, for a thread that waits for the last items of others. These take microseconds, unless a thread has lost
/// its core.
void wait_for_items(const std::atomic<int>& unfinished, int left) {
  using namespace std::chrono_literals;
  const auto start = Clock::now();
  wait_while_equal(unfinished, left);
  const auto end = Clock::now();
  if (end - start > 1ms)
    short_of_cores_until.store((end + 100ms).time_since_epoch().count(), std::memory_order_relaxed);
}

} // namespace

ThreadTeam::ThreadTeam(int threads) {
  if (threads < 1) throw std::invalid_argument("a thread team needs at least one thread");
  try {
    workers_.reserve(static_cast<std::size_t>(threads - 1));
    for (int thread = 1; thread < threads; ++thread) workers_.emplace_back([this, thread] { work(thread); });
  } catch (...) {
    stop_workers();
    throw;
  }
}

ThreadTeam::~ThreadTeam() {
  stop_workers();
}

void ThreadTeam::stop_workers() {
  stop_.store(true, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadTeam::for_each(int count, const std::function<void(int item, int thread)>& body) {
  for_each_range(count, [&body](int begin, int end, int thread) {
    for (int item = begin; item < end; ++item) body(item, thread);
  });
}

void ThreadTeam::for_each_range(int count, const std::function<void(int begin, int end, int thread)>& body) {
  if (workers_.empty()) {
    for (int item = 0; item < count; item += most_together) body(item, std::min(item + most_together, count), 0);
    return;
  }
  if (count <= 0) return;
  body_ = &body;
  count_ = count;
  error_ = nullptr;
  failed_.store(count, std::memory_order_relaxed);
  unfinished_items_.store(count, std::memory_order_relaxed);
  const unsigned round = round_.load(std::memory_order_relaxed) + 1;
  waiting_items_.store(std::uint64_t{round} << 32 | static_cast<std::uint32_t>(count),
                       std::memory_order_release); // publishes all of the above
  round_.store(round, std::memory_order_release);
  round_.notify_all();

  run_items(0);
  for (int left = unfinished_items_.load(std::memory_order_acquire); left != 0;
       left = unfinished_items_.load(std::memory_order_acquire))
    wait_for_items(unfinished_items_, left);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void ThreadTeam::work(int thread) {
  for (unsigned seen = 0;;) {
    wait_while_equal(round_, seen);
    seen = round_.load(std::memory_order_acquire); // rounds may have ended without this thread
    if (stop_.load(std::memory_order_relaxed)) return;
    run_items(thread);
  }
}

/// The next items of the current round, or all that are left; none if there are none.
ThreadTeam::Items ThreadTeam::take_items(bool all) {
  std::uint64_t waiting = waiting_items_.load(std::memory_order_acquire);
  for (;;) {
    const auto left = static_cast<int>(static_cast<std::uint32_t>(waiting));
    if (left == 0) return {};
    // Neighbouring items on one thread, and single ones towards the end, so that the threads end together.
    const int taken = all ? left : std::clamp(left / (8 * size()), 1, most_together);
    if (waiting_items_.compare_exchange_weak(waiting, waiting - static_cast<std::uint64_t>(taken),
                                             std::memory_order_acq_rel, std::memory_order_acquire))
      return {count_ - left, taken};
  }
}

void ThreadTeam::run_items(int thread) {
  int finished = 0;
  for (Items items = take_items(false); items.count > 0; items = take_items(false)) {
    finished += items.count;
    // Items below those that have failed still begin, so that the lowest failure is found.
    if (items.begin > failed_.load(std::memory_order_relaxed)) continue;
    try {
      (*body_)(items.begin, items.begin + items.count, thread);
    } catch (...) {
      const std::lock_guard lock(error_mutex_);
      if (items.begin < failed_.load(std::memory_order_relaxed)) {
        error_ = std::current_exception();
        failed_.store(items.begin, std::memory_order_relaxed);
      }
      finished += take_items(true).count; // nobody begins them
    }
  }
  if (finished > 0 && unfinished_items_.fetch_sub(finished, std::memory_order_acq_rel) == finished)
    unfinished_items_.notify_one();
}

} // namespace mpfem
