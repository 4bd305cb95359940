#pragma once

#include <functional>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Runs `body` on all ranks and returns its exit code. What all of them print on standard output is printed by the
/// first alone. Where all fail, the first prints its error in one line, as run_program() does; where only some do, each
/// of them prints its own, and all ranks are ended. On a single rank it is just a call of `body`.
int on_all_ranks(const char* program, const Communicator& ranks, const std::function<int()>& body);

} // namespace mpfem
