#pragma once

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Collective. Number of cores that a rank has for its threads. A core that several ranks on the same machine may use
/// is shared equally among them. At least 1.
int share_of_cores(const Communicator& ranks);

} // namespace mpfem
