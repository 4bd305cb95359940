#pragma once
// Two lines that meet at a kink.

#include "postproc/fits/linear_fit.hpp"

namespace mpfem {

/// y = y_kink + (x < kink ? slope_below : slope_above) (x - kink). The kink is the one of 4001 evenly spaced places,
/// between the second x from either end, with the least squares. Its 95 % interval is that of its profile. Needs five
/// different x. Throws InputError where the points do not determine the coefficients.
Fit bilinear_fit(const FitProblem& problem);

} // namespace mpfem
