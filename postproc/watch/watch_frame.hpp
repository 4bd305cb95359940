#pragma once
// What `postproc watch` shows of a run.

#include <string>

#include "postproc/watch/run_progress.hpp"

namespace mpfem {

/// Several lines, each with its line end: where the run is, its last row, how sound it is, when its stage may end, and
/// the curve of mean stress over relative density. `now`: s, of the system's clock; `width`: columns of the terminal.
std::string watch_frame(const RunProgress& progress, double now, int width = 80);

} // namespace mpfem
