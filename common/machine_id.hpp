#pragma once
// The machine on which this process runs: whether two processes share one.

#include <string>

namespace mpfem {

/// Names the machine on which this process runs, until it is started anew: the same for all its processes, another one
/// for every other machine. Not for files: it says nothing to a reader.
std::string machine_id();

} // namespace mpfem
