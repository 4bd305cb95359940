#pragma once
// The display of `postproc watch`.

#include <string>

#include "postproc/watch/run_progress.hpp"

namespace mpfem {

/// Several lines, each with its line break: state of the run, its last row, its quality, expected end of the stage, and
/// the curve of mean stress over relative density. `now`: s, system clock; `width`: columns of the terminal.
std::string watch_frame(const RunProgress& progress, double now, int width = 80);

} // namespace mpfem
