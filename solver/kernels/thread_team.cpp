#include "solver/kernels/thread_team.hpp"

#include <algorithm>
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

/// Returns when the atomic no longer holds `old`. The loops of one time step follow each other within microseconds: a
/// short spin saves the sleep and wake-up between them, and no more, since other programs may need the core.
template <class Value>
void wait_while_equal(const std::atomic<Value>& atomic, Value old) {
  constexpr int spins = 2000;
  for (int i = 0; i < spins; ++i) {
    if (atomic.load(std::memory_order_acquire) != old) return;
    pause_briefly();
  }
  atomic.wait(old, std::memory_order_acquire);
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
  if (workers_.empty()) {
    for (int item = 0; item < count; ++item) body(item, 0);
    return;
  }
  body_ = &body;
  count_ = count;
  // Neighbouring items on one thread, as far as the threads still end together.
  chunk_ = std::clamp(count / (32 * size()), 1, 8);
  error_ = nullptr;
  failed_.store(count, std::memory_order_relaxed);
  next_.store(0, std::memory_order_relaxed);
  busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release); // publishes all of the above
  round_.notify_all();

  run_items(0);
  for (int busy = busy_.load(std::memory_order_acquire); busy != 0; busy = busy_.load(std::memory_order_acquire))
    wait_while_equal(busy_, busy);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void ThreadTeam::work(int thread) {
  for (unsigned seen = 0;;) {
    wait_while_equal(round_, seen);
    // A new round begins only when all workers have left the last one, so none is ever skipped.
    ++seen;
    if (stop_.load(std::memory_order_relaxed)) return;
    run_items(thread);
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
  }
}

void ThreadTeam::run_items(int thread) {
  for (int begin = next_.fetch_add(chunk_, std::memory_order_relaxed); begin < count_;
       begin = next_.fetch_add(chunk_, std::memory_order_relaxed)) {
    for (int item = begin; item < std::min(begin + chunk_, count_); ++item) {
      // Items below one that has failed still begin: the lowest failure is to be found.
      if (item > failed_.load(std::memory_order_relaxed)) break;
      try {
        (*body_)(item, thread);
      } catch (...) {
        const std::lock_guard lock(error_mutex_);
        if (item < failed_.load(std::memory_order_relaxed)) {
          error_ = std::current_exception();
          failed_.store(item, std::memory_order_relaxed);
        }
        next_.store(count_, std::memory_order_relaxed);
      }
    }
  }
}

} // namespace mpfem
