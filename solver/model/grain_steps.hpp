#pragma once
// What is remembered of the largest frequency of each grain as a whole, which sets the stable step.

#include <vector>

#include "solver/model/lazy_array.hpp"

namespace mpfem {

/// The state when the largest frequency of each grain was last found, and how much it may have grown since. Arrays are
/// [grains], except one. Set for the rank's own grains.
struct GrainSteps {
  std::vector<double> whole;  ///< s, stable step
  std::vector<double> growth; ///< bound of the factor by which single tets' frequencies squared have grown since
  LazyArray<double> contact;  ///< 1/s^2, [nodes]: share of contact in the frequency squared at that time
};

} // namespace mpfem
