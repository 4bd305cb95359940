#pragma once
// Studies whose results lie in the same folder: their runs must not replace each other.

#include "postproc/figure/depends.hpp"

namespace mpfem {

/// Throws InputError if another study with results in the same folder has a run in the same folder that is not the same
/// run: with other settings, or from another packing. Studies and records that cannot be read any more are passed over.
void refuse_runs_of_other_studies(const Figure& figure, const DependsRequest& request);

} // namespace mpfem
