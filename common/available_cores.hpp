#pragma once
// How many cores this process may use.

namespace mpfem {

/// Number of cores of the machine that a batch system or taskset has left to this process. At least 1.
int available_cores();

} // namespace mpfem
