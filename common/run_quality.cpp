#include "common/run_quality.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpfem {

std::vector<std::string> quality_warnings(std::span<const QualityRow> rows) {
  double work = 0, residual = 0, highest_stress = 0, penetration = 0, density = 0, first_step = 0, shortest_step = 0;
  for (const QualityRow& row : rows) {
    work = std::max(work, std::abs(row.external_work));
    residual = std::max(residual, std::abs(row.energy_residual));
    highest_stress = std::max(highest_stress, row.mean_stress);
    penetration = std::max(penetration, row.penetration);
    density = std::max(density, row.current_density);
    if (!(row.time_step > 0)) continue;
    if (first_step == 0) first_step = shortest_step = row.time_step;
    shortest_step = std::min(shortest_step, row.time_step);
  }
  double kinetic = 0;
  for (const QualityRow& row : rows)
    if (row.internal_energy > 0 && highest_stress > 0 && row.mean_stress >= 0.1 * highest_stress)
      kinetic = std::max(kinetic, row.kinetic_energy / row.internal_energy);

  std::vector<std::string> warnings;
  if (work > 0 && residual > doubtful_residual * work)
    warnings.push_back(fmt::format("the energy balance is off by up to {:.2g} % of the largest work (warning above "
                                   "{:g} %): lower numerics.time_step_factor",
                                   100 * residual / work, 100 * doubtful_residual));
  if (kinetic > doubtful_kinetic)
    warnings.push_back(fmt::format("kinetic energy is up to {:.2g} times the internal energy under load (warning above "
                                   "{:g}): inertia carries part of the stress; reduce the speeds",
                                   kinetic, doubtful_kinetic));
  if (penetration > doubtful_penetration)
    warnings.push_back(fmt::format(
        "nodes penetrate by up to {:.2g} element sizes (warning above {:g}): raise contact.stiffness_factor",
        penetration, doubtful_penetration));
  if (density > doubtful_density)
    warnings.push_back(fmt::format("the grains' current volume is up to {:.4g} times the box's volume (warning above "
                                   "{:g}): no pores are left, or grains overlap",
                                   density, doubtful_density));
  if (shortest_step < doubtful_step_share * first_step)
    warnings.push_back(fmt::format(
        "the time step fell to {:.2g} times the first one (warning below {:g}): some elements are nearly flat",
        shortest_step / first_step, doubtful_step_share));
  return warnings;
}

} // namespace mpfem
