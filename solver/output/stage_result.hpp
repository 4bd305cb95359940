#pragma once
// How a stage ended. Run files keep all but `hold_stress` and `missed`, checkpoints all but `missed`.

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
  /// "'upper' 12 N instead of 40 N": pushes of tools (N or MPa) that were to be held and never reached, after what the
  /// tools bore when the stage ended. Only for the message at that end; empty if all were reached, and in a stage that
  /// was read from a checkpoint.
  std::string missed{};
};

} // namespace mpfem
