#pragma once
// Metrics of tablets are those of round dies.

#include "results-schema/file.hpp"

namespace mpfem {

/// Throws InputError where the run has a die that is not round; `required`: or none.
void refuse_other_than_round_dies(const schema::FileReader& run, bool required);

} // namespace mpfem
