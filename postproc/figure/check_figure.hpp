#pragma once
// The names by which the parts of a figure refer to each other.

#include "postproc/figure/figure.hpp"

namespace mpfem {

/// Finds names that are declared twice and references to unknown names, before anything is run. Throws InputError with
/// the place.
void check_names(const Figure& figure);

} // namespace mpfem
