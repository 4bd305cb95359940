#pragma once

namespace mpfem {

/// Cores that this process may use: those that a batch system or taskset has left it of the machine's. At least 1.
int available_cores();

} // namespace mpfem
