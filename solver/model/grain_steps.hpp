#pragma once
// What is kept of the largest frequency of each grain as a whole, which sets the stable step.

#include <vector>

#include "solver/model/lazy_array.hpp"

namespace mpfem {

/// Grains when the largest frequency of each was last found, and how much that may have grown since; [grains] but for
/// one. Set for the rank's own grains.
struct GrainSteps {
  std::vector<double> whole;  ///< s, stable step
  std::vector<double> growth; ///< factor by which single tets' frequencies squared have grown since, at most
  LazyArray<double> contact;  ///< 1/s^2, [nodes]: share of contact in the frequency squared, then
};

} // namespace mpfem
