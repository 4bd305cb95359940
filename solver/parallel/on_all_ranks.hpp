#pragma once
// The whole program on all ranks: one exit code, and errors printed once.

#include <functional>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Runs `body` on all ranks and returns its exit code. Only the first rank prints on standard output. If all fail, the
/// first prints its error in one line, as run_program() does. If only some fail, each of those prints its own error,
/// and all ranks are ended. On a single rank this only calls `body`.
int on_all_ranks(const char* program, const Communicator& ranks, const std::function<int()>& body);

} // namespace mpfem
