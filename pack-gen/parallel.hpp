#pragma once
// A loop over independent items on a few threads.

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace mpfem {

/// Calls body(i) for i in 0 … count - 1, each once, in any order. Where threads cannot be started, those there are do
/// their share. Of several exceptions, that of the lowest i is rethrown here, whatever the number of threads.
template <class Body>
void for_each_parallel(std::size_t count, int threads, Body body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::size_t failed = count;
  std::mutex guard;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (i < failed) {
          failed = i;
          failure = std::current_exception();
        }
        next = count; // lower items are all taken, and end
      }
    }
  };
  {
    std::vector<std::jthread> team;
    try {
      for (int t = 1; t < threads; ++t) team.emplace_back(work);
    } catch (const std::system_error&) { // the system has no more
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

} // namespace mpfem
