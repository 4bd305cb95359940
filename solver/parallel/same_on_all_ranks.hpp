#pragma once
// What has to be the same on all ranks before a run begins: scenario, command and build.

#include <string>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// Collective. Throws InputError if `own` is not the same text on all ranks: names the first line that differs, before
/// what is `allowed`.
void refuse_differences(const Communicator& ranks, const std::string& own, const std::string& allowed);

/// Collective. Throws InputError if not all ranks are of one build. `own` describes that of this rank. Builds for other
/// processors lay data out in another way, so their messages would be misread.
void refuse_different_builds(const Communicator& ranks, const std::string& own);

} // namespace mpfem
