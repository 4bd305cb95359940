#pragma once
// Unconfined stress over the current face of the sample, and over its initial face.

#include <vector>

#include "postproc/run_data/history_table.hpp"
#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Growth factor of a sample's cross-section since the stage began, one value per row of the stage: the growth of the
/// standard deviation of its mass along x, times that along y. Exact for a sample that widens uniformly. Grains that
/// fly off count too much, so that it has no meaning once a sample has fallen apart. Empty where the history lacks
/// these columns (files of earlier versions).
std::vector<double> cross_section_growth(const HistoryTable& history, const StageRows& stage);

/// Adds to the strength of an unconfined test, with uncertainties: nominal_strength_MPa (force over the face at the
/// stage's beginning) and true_stress_at_strength_MPa (over the face at strength); also largest_true_stress_MPa with
/// its strain, and cross_section_growth_at_strength. All but the nominal ones are null where the growth is not known.
/// Adds nothing to other tests.
void add_true_stress(Measurement& strength, const HistoryTable& history, const StageRows& stage);

} // namespace mpfem
