#pragma once
// What is remembered of the estimates of each grain's stable step.

#include <cstddef>
#include <vector>

#include "solver/model/lazy_array.hpp"

namespace mpfem {

/// The last estimate of each grain's stable step, and the state when the largest frequency of the grain as a whole was
/// last found. Arrays are [grains], except one. Set for the rank's own grains.
struct GrainSteps {
  // At the last estimate of the grain, and since.
  std::vector<double> step;          ///< s, stable step
  std::vector<double> contact_share; ///< factor by which contact shortens the stable step of its tets
  std::vector<double> strain;        ///< sum over the steps since then of the largest strain of a tet in each
  // When the frequency of the whole grain was last found, and since.
  std::vector<double> whole;     ///< s, stable step
  std::vector<double> growth;    ///< bound of the factor by which single tets' frequencies squared have grown since
  std::vector<double> rate;      ///< 1/s, volumetric, which that frequency allows for
  std::vector<double> estimates; ///< number of estimates since
  LazyArray<double> contact;     ///< 1/s^2, [nodes]: share of contact in the frequency squared at that time

  GrainSteps() = default;
  GrainSteps(std::size_t grains, std::size_t nodes, Pages pages)
      : step(grains), contact_share(grains), strain(grains), whole(grains), growth(grains), rate(grains),
        estimates(grains), contact(nodes, pages) {}
};

} // namespace mpfem
