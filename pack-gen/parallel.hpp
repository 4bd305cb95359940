#pragma once
// A loop over independent items on a few threads.

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace mpfem {

/// Calls body(i) for i in 0 … count - 1, each once, in any order. The first exception is rethrown here.
template <class Body>
void for_each_parallel(std::size_t count, int threads, Body body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> team;
  for (int t = 1; t < threads; ++t) team.emplace_back(work);
  work();
  for (std::thread& thread : team) thread.join();
  if (failure) std::rethrow_exception(failure);
}

} // namespace mpfem
