#pragma once
// One stage of a run, row by row: the curves from which strengths, moduli and yield points are read.

#include <string>
#include <vector>

#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Row 0 is the state in which the stage begins. Strains are logarithmic, counted from there; compression positive.
struct StageCurve {
  int stage = 0;
  std::string type;                        ///< as in the scenario; empty where it is not known
  std::size_t first_row = 0;               ///< row of the history that is row 0 here
  std::vector<double> axial_strain;        ///< 1
  std::vector<double> volumetric_strain;   ///< 1
  std::vector<double> axial_stress;        ///< MPa, mean of both z walls
  std::vector<double> lateral_stress;      ///< MPa, mean of the four others
  std::vector<double> mean_stress;         ///< MPa, p
  std::vector<double> deviatoric_stress;   ///< MPa, q
  std::vector<double> relative_density;    ///< 1
  std::vector<double> plastic_dissipation; ///< mJ, since the run began
  std::vector<double> damage_dissipation;  ///< mJ, since the run began
  std::vector<double> axial_work;          ///< mJ, by the z walls since the stage began (trapezoids)
  std::string path;                        ///< for messages
  bool unconfined = false;                 ///< the lateral walls carry next to nothing
  std::size_t rows() const { return axial_strain.size(); }
};

/// A stage is unconfined where the median of the lateral stress over its rows, without the first, is below 1 % of the
/// largest axial stress. Lateral walls that have moved away no longer give the sample's cross-section: the axial stress
/// is then the walls' force over the face at the stage's beginning, otherwise the mean wall stress, over the face of
/// the row. Throws InputError.
StageCurve stage_curve(const HistoryTable& history, const StageRows& rows, const std::string& path);

} // namespace mpfem
