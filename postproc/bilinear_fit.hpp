#pragma once
// Two lines that meet at a kink.

#include "postproc/linear_fit.hpp"

namespace mpfem {

/// y = y_kink + (x < kink ? slope_below : slope_above) (x - kink). The kink of least squares is sought on 4001 places
/// between the second x from either end, its 95 % interval is that of its profile. Needs five different x. Throws
/// InputError where the points do not determine the coefficients.
Fit bilinear_fit(const FitProblem& problem);

} // namespace mpfem
