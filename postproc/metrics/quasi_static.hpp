#pragma once
// How quasi-static a loading was: inertia, balance of opposite walls, balance of energy.

#include <optional>

#include "postproc/metrics/inertia.hpp"
#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Over the rows of a stage with an axial stress above a fifth of its largest value and, if the stage loads, up to that
/// value: largest kinetic over internal energy (the value), inertial numbers where `grains` are known, and the mean
/// difference of both z walls' stress over the mean axial stress. Over the whole stage: the largest change of the
/// energy residual since the run began, over the largest work since then.
Measurement quasi_static(const HistoryTable& history, const StageRows& stage,
                         const std::optional<GrainInertia>& grains);

/// The same of a file, for stage `number` (as in stage_by_number; default: the last). Throws InputError.
Measurement measure_quasi_static(const schema::FileReader& file, std::optional<int> number);

} // namespace mpfem
