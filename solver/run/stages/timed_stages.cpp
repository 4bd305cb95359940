#include "solver/run/stages/timed_stages.hpp"

#include <algorithm>

namespace mpfem {

double TimedStage::fraction_done(double time, double /*mean_stress*/) const {
  return motion_.duration > 0 ? std::clamp(time / motion_.duration, 0.0, 1.0) : 1.0;
}

} // namespace mpfem
