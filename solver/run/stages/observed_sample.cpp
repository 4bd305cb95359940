#include "solver/run/stages/observed_sample.hpp"

#include <cmath>

namespace mpfem {

ObservedSample observe_sample(const StageObservation& seen, const std::array<double, 3>& start_length,
                              double solid_volume) {
  ObservedSample s;
  s.time = seen.time, s.step = seen.step, s.rate_factor = seen.rate_factor;
  s.plastic_dissipation = seen.plastic_dissipation;
  s.length = seen.cell.lengths();
  const double cell_volume = seen.cell.volume();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    s.area[axis] = cell_volume / s.length[axis];
    s.force[axis] = seen.force[axis];
    s.stress[axis] = seen.force[axis] / s.area[axis];
    s.strain[axis] = std::log(start_length[axis] / s.length[axis]);
    s.mean_stress += s.stress[axis] / 3;
  }
  s.deviatoric_stress = s.stress[2] - 0.5 * (s.stress[0] + s.stress[1]);
  s.relative_density = solid_volume / cell_volume;
  return s;
}

} // namespace mpfem
