#pragma once
// A description of the machine, for the provenance of results.

#include <string>

namespace mpfem {

/// Operating system, architecture, processor model and number of logical processors, in one line; no host name.
/// Anything that the system does not tell is "unknown".
std::string physical_host();

} // namespace mpfem
