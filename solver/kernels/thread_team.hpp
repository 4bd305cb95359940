#pragma once
// A team of persistent threads that share a loop over grains. One of the few files that know threads.

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace mpfem {

/// Runs loops over independent items on a fixed number of threads. Items are handed out a few at a time, so which
/// thread runs an item is not determined: an item must write to its own data only, and sums over items are made
/// afterwards in item order, so that results do not depend on the number of threads.
///
/// A loop ends when its items are done. It does not wait for a thread that holds no item. So a thread whose core is
/// taken by another program delays the others only by the items that it has begun.
class ThreadTeam {
public:
  /// `threads` >= 1, the calling thread included. Throws std::invalid_argument, or std::system_error where the system
  /// has no more threads.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(item, thread) for item = 0 … count-1, thread in 0 … size()-1, and returns when all are done. Items
  /// begin in ascending order. After an exception no further items are handed out, and the exception of the lowest
  /// failing item is rethrown here: the same one for any number of threads. Not to be called by two threads at once,
  /// nor by a body.
  void for_each(int count, const std::function<void(int item, int thread)>& body);

  /// The same, but calls body(begin, end, thread) for neighbouring items together. How many is not determined;
  /// most_together at most.
  void for_each_range(int count, const std::function<void(int begin, int end, int thread)>& body);
  static constexpr int most_together = 8;

private:
  struct Items {
    int begin = 0, count = 0;
  };
  void work(int thread);
  void run_items(int thread);
  Items take_items(bool all);
  void stop_workers();

  std::vector<std::thread> workers_;
  const std::function<void(int, int, int)>* body_ = nullptr;
  int count_ = 0;
  // On separate cache lines, so that handing out items does not disturb threads that wait for the next round.
  /// The number of the round in the upper half, the number of items not yet taken in the lower half. One number holds
  /// both, so that a late thread cannot take an item of the wrong round. A thread that holds an item holds the round:
  /// until the item is done, body_ and count_ do not change.
  alignas(64) std::atomic<std::uint64_t> waiting_items_{0};
  alignas(64) std::atomic<int> unfinished_items_{0};
  alignas(64) std::atomic<unsigned> round_{0};
  std::atomic<bool> stop_{false};
  std::mutex error_mutex_;
  std::exception_ptr error_;
  std::atomic<int> failed_{0}; ///< the first of the lowest items that have failed together, count_ while none has
};

} // namespace mpfem
