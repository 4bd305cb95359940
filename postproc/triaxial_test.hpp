#pragma once
// What a triaxial compression did, and how well it was done.

#include <optional>

#include "postproc/inertia.hpp"
#include "postproc/measurement.hpp"
#include "postproc/stages.hpp"

namespace mpfem {

/// Deviatoric stress and volumetric strain at the end and at their largest, dissipation, damage; how far the force on
/// the lateral walls departs from what `lateral_stress` (MPa) makes on their faces at the beginning, after 2 % of axial
/// strain, and the largest kinetic over internal energy and inertial numbers (where `grains` are known) over the
/// stage's own rows. Strains are logarithmic, compression positive, and like the dissipated energies counted from the
/// stage's first row.
Measurement triaxial_test(const HistoryTable& history, const StageRows& stage, double lateral_stress,
                          const std::optional<GrainInertia>& grains);

/// The same of a file, for `number` or its last triaxial compression. Throws InputError.
Measurement measure_triaxial_test(const schema::FileReader& file, std::optional<int> number, double lateral_stress);

} // namespace mpfem
