#pragma once
// Windows of rows, with the ranges of strain and stress in them.

#include <string>
#include <vector>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

/// Window of rows of a stage's curve: axial strain, and one of its stresses (`stress`, MPa, one value per row) by name.
Window axial_window(const StageCurve& curve, RowRange rows, const std::string& stress_name,
                    const std::vector<double>& stress);

/// Window of history rows that belong to a stage: volumetric strain and mean stress.
Window isotropic_window(const HistoryTable& history, const StageRows& stage, RowRange rows);

} // namespace mpfem
