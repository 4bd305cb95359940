#pragma once
// How a stage ended, as run files and checkpoints keep it.

#include <string>

namespace mpfem {

/// The end of one stage.
struct StageResult {
  std::string name{};
  std::string ended_by{};           ///< "relative density 0.92", and which speed the stage chose, if it chose one
  double overshoot = 0;             ///< MPa by which a stress that ended or turned the stage was passed
  double hold_error = 0;            ///< MPa, largest deviation of a held stress, averaged over a transit of the box
  double hold_stress = 0;           ///< MPa, the largest stress to be held
  double hold_root_mean_square = 0; ///< MPa, root mean square of the deviation at every step
  std::string missed{};             ///< the forces of tools that were never reached, and what the tools bear instead
};

} // namespace mpfem
