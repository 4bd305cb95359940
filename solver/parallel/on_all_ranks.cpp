#include "solver/parallel/on_all_ranks.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

namespace {

/// Ranks that fail together do so within this time (s) of each other; one of them may have had a file to write.
constexpr double patience = 10;

} // namespace

int on_all_ranks(const char* program, const Communicator& ranks, const std::function<int()>& body) {
  if (ranks.alone()) return body();
  if (!ranks.is_root() && std::freopen("/dev/null", "w", stdout) == nullptr)
    throw StorageError("/dev/null: cannot be written");
  try {
    return body();
  } catch (...) {
    Failure failure = present_failure();
    if (ranks.is_root()) report(program, failure);
    const bool together = ranks.all_arrive_within(patience);
    if (together) return static_cast<int>(failure.code);
    if (!ranks.is_root()) {
      failure.message = fmt::format("rank {}: {}", ranks.rank(), failure.message);
      report(program, failure);
    }
    ranks.abort(static_cast<int>(failure.code));
  }
}

} // namespace mpfem
