#pragma once
// How quasi-static a loading was: inertia, balance of opposite walls, balance of energy.

#include <optional>

#include "postproc/inertia.hpp"
#include "postproc/measurement.hpp"
#include "postproc/stages.hpp"

namespace mpfem {

/// Largest kinetic over internal energy and, where `grains` are known, inertial numbers over the rows of a stage in
/// which the axial stress exceeds a fifth of its largest value and, where it rises, up to that value; over the same
/// rows the mean difference of both z walls' stress over the mean axial stress; over the whole stage the largest change
/// of the energy residual since the run began, over the largest work since then.
Measurement quasi_static(const HistoryTable& history, const StageRows& stage,
                         const std::optional<GrainInertia>& grains);

/// The same of a file, for `number` as in choose_stage (the last without). Throws InputError.
Measurement measure_quasi_static(const schema::FileReader& file, std::optional<int> number);

} // namespace mpfem
