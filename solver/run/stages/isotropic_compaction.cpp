#include "solver/run/stages/isotropic_compaction.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

IsotropicCompactionControl::IsotropicCompactionControl(const IsotropicCompaction& stage, const StageLabel& label,
                                                       const StageStart& start)
    : TimedStage(start), relative_density_(stage.relative_density) {
  const double density = start.sample.solid_volume / start.cell.volume();
  // Nearer than this, the walls would move by rounding errors.
  if (!(stage.relative_density > density * (1 + 1e-9)))
    throw InputError(
        fmt::format("{}stage '{}': key 'relative_density': found {}, allowed: more than the density at its "
                    "start, {:.4f}",
                    label.places.prefix("relative_density"), label.name, stage.relative_density, density));
  motion_.end_scale.fill(std::cbrt(density / stage.relative_density));
  motion_.ramp = stage.ramp_fraction;
  motion_.duration =
      0.5 * start.cell.longest() * (1.0 - motion_.end_scale[0]) / (stage.wall_speed * (1.0 - motion_.ramp));
}

StageResult IsotropicCompactionControl::result(const StageObservation& /*last*/) const {
  return {.ended_by = fmt::format("relative density {:g}", relative_density_)};
}

} // namespace mpfem
