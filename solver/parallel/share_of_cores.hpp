#pragma once

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Collective. Cores that a rank has for its threads: of those that it may use, its share where other ranks on the same
/// machine may use them too. At least 1.
int share_of_cores(const Communicator& ranks);

} // namespace mpfem
