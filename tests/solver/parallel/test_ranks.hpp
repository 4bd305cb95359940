#pragma once

#include "solver/parallel/communicator.hpp"

namespace mpfem::test {

/// The ranks that mpirun started this test with; one rank without mpirun.
inline const Communicator& test_ranks() {
  static int no_arguments = 0;
  static char** none = nullptr;
  static const Communicator ranks = Communicator::of_launcher(no_arguments, none);
  return ranks;
}

} // namespace mpfem::test
