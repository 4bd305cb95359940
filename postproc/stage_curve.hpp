#pragma once
// What one stage of a run did, row by row: the curves that strengths, moduli and yield points are read from.

#include <string>
#include <vector>

#include "postproc/stages.hpp"

namespace mpfem {

/// Row 0 is the state in which the stage begins. Strains are logarithmic, counted from there; compression positive.
struct StageCurve {
  int stage = 0;
  std::string type;                        ///< as in the scenario; empty where it is not known
  std::size_t first_row = 0;               ///< of the history, row 0 here
  std::vector<double> axial_strain;        ///< 1
  std::vector<double> volumetric_strain;   ///< 1
  std::vector<double> axial_stress;        ///< MPa, mean of both z walls
  std::vector<double> lateral_stress;      ///< MPa, mean of the four others
  std::vector<double> mean_stress;         ///< MPa, p
  std::vector<double> deviatoric_stress;   ///< MPa, q
  std::vector<double> relative_density;    ///< 1
  std::vector<double> plastic_dissipation; ///< mJ, since the run began
  std::vector<double> damage_dissipation;  ///< mJ, since the run began
  std::vector<double> axial_work;          ///< mJ, of the z walls since the stage began (trapezoids)
  std::string path;                        ///< for messages
  bool unconfined = false;                 ///< the lateral walls carry next to nothing
  std::size_t rows() const { return axial_strain.size(); }
};

/// A stage is unconfined where the median over its rows (its first left out) of the lateral stress is below 1 % of the
/// largest axial stress. Lateral walls that are gone no longer tell the sample's cross-section: then the axial stress
/// is the walls' force over the face at the stage's beginning, else the mean wall stress, over the face of the row.
/// Throws InputError.
StageCurve stage_curve(const HistoryTable& history, const StageRows& rows, const std::string& path);

} // namespace mpfem
