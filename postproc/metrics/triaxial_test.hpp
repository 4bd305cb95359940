#pragma once
// Results of a triaxial compression, and its quality.

#include <optional>

#include "postproc/metrics/inertia.hpp"
#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Deviatoric stress (MPa) at the end (the value) and at its largest; volumetric strain at the end; axial strains of
/// the largest deviatoric stress and of the largest contraction; dissipation (mJ), damage; deviation, beyond an axial
/// strain of 2 %, of the force on the lateral walls from the force of `lateral_stress` (MPa) on their initial faces;
/// largest kinetic over internal energy and inertial numbers (where `grains` are known) over the stage's own rows.
/// Strains are logarithmic, compression positive, and like the dissipated energies counted from the stage's first row.
Measurement triaxial_test(const HistoryTable& history, const StageRows& stage, double lateral_stress,
                          const std::optional<GrainInertia>& grains);

/// The same of a file, for stage `number` (default: the last triaxial_compression, otherwise the last stage). Throws
/// InputError.
Measurement measure_triaxial_test(const schema::FileReader& file, std::optional<int> number, double lateral_stress);

} // namespace mpfem
