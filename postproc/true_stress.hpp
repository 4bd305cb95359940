#pragma once
// Unconfined stress over the face that the sample has, and over the face that it had.

#include <vector>

#include "postproc/history_table.hpp"
#include "postproc/measurement.hpp"
#include "postproc/stages.hpp"

namespace mpfem {

/// By how much a sample's cross-section has grown since the stage began, row by row of it: the product of what the
/// standard deviations of its mass along x and y have grown by. Exact for a sample that widens evenly; grains that fly
/// off count too much, so that it means nothing once a sample has fallen apart. Empty where the history does not tell
/// (files of earlier versions).
std::vector<double> cross_section_growth(const HistoryTable& history, const StageRows& stage);

/// Adds to the strength of an unconfined test: nominal_strength_MPa (force over the face at the stage's beginning),
/// true_stress_at_strength_MPa (over the face then), largest_true_stress_MPa with its strain, and
/// cross_section_growth_at_strength; null where the history does not tell the true ones. Nothing for other tests.
void add_true_stress(Measurement& strength, const HistoryTable& history, const StageRows& stage);

} // namespace mpfem
